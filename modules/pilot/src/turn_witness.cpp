// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/turn_witness.h>

#include <homeward/core/angle.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

constexpr double kTurn = radians(10.0); ///< between scans that are compared, at least
constexpr double kWay = 0.1;            ///< metres that the robot may have moved on meanwhile
constexpr double kClearly = 0.1; ///< metres a reading that the other way round fits better by
constexpr int kOften = 2;

} // namespace

double scanMisfit(const Scan &before, const Scan &after, int shift)
{
  const int count = static_cast<int>(std::min(before.ranges.size(), after.ranges.size()));
  double sum = 0.0;
  int pairs = 0;
  for (int i = std::max(0, -shift); i < std::min(count, count - shift); ++i) {
    const int j = i + shift;
    const double difference = std::abs(after.ranges[static_cast<std::size_t>(i)] -
                                       before.ranges[static_cast<std::size_t>(j)]);
    if (!std::isnan(difference)) {
      sum += std::min(difference, 1.0);
      ++pairs;
    }
  }
  return 4 * pairs > count ? sum / pairs : std::numeric_limits<double>::infinity();
}

bool TurnWitness::contradicts(const Scan &scan, const Pose2 &oMr)
{
  const auto renew = [&] { m_before = View{scan, oMr}; };
  if (!m_before || scan.ranges.size() != m_before->scan.ranges.size()) {
    renew();
    return false;
  }
  if (scan.stamp == m_before->scan.stamp) {
    return false;
  }
  const Pose2 moved = m_before->oMr.inverse() * oMr;
  if (moved.translation().norm() > kWay) {
    renew();
    return false;
  }
  if (std::abs(moved.heading) < kTurn) {
    return false;
  }
  const int shift = static_cast<int>(std::lround(moved.heading / scan.angleStep));
  const double straight = scanMisfit(m_before->scan, scan, shift);
  const double reversed = scanMisfit(m_before->scan, scan, -shift);
  m_contradictions =
      2.0 * reversed < straight && straight - reversed > kClearly ? m_contradictions + 1 : 0;
  renew();
  return m_contradictions >= kOften;
}

bool saysEnough(const Scan &scan)
{
  const auto known = std::count_if(scan.ranges.begin(), scan.ranges.end(),
                                   [](float range) { return !std::isnan(range); });
  return 2 * known >= static_cast<std::ptrdiff_t>(scan.ranges.size());
}

} // namespace homeward
