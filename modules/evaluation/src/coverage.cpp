// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/coverage.h>

namespace homeward
{

CoverageMeter::CoverageMeter(const FreeSpace &space, const Eigen::Vector2d &start, double reach)
    : m_space(space), m_reach(reach), m_uncovered(space.reachableCells(start)),
      m_all(m_uncovered.size())
{}

void CoverageMeter::add(const Eigen::Vector2d &place)
{
  std::erase_if(m_uncovered, [&](const Eigen::Vector2d &cell) {
    return (place - cell).norm() <= m_reach && m_space.sees(place, cell);
  });
}

double CoverageMeter::share() const
{
  return m_all == 0 ? 0.0
                    : 1.0 - static_cast<double>(m_uncovered.size()) / static_cast<double>(m_all);
}

std::vector<CoverageSample>
coverageOverTime(const FreeSpace &space, const Eigen::Vector2d &start,
                 const std::vector<std::pair<double, Eigen::Vector2d>> &made, double reach)
{
  CoverageMeter meter(space, start, reach);
  std::vector<CoverageSample> samples;
  for (const auto &[seconds, place] : made) {
    meter.add(place);
    samples.push_back({seconds, meter.share()});
  }
  return samples;
}

} // namespace homeward
