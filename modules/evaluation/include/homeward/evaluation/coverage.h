// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/free_space.h>

#include <utility>
#include <vector>

namespace homeward
{

/** How much of the reachable floor the places of a map cover, as they are added. */
class CoverageMeter
{
public:
  /**
   * @param space outlives the meter
   * @param start reachable floor is what can be reached from it; metres, world frame
   * @param reach metres within which, in free line of sight, a place covers floor
   */
  CoverageMeter(const FreeSpace &space, const Eigen::Vector2d &start, double reach);

  /** Adds a place; metres, world frame. */
  void add(const Eigen::Vector2d &place);

  /** Covered so far, 0 to 1; 0 where nothing is reachable. */
  double share() const;

private:
  const FreeSpace &m_space;
  double m_reach;
  std::vector<Eigen::Vector2d> m_uncovered; ///< cells
  std::size_t m_all;
};

/** Covered floor at a time. */
struct CoverageSample
{
  double seconds = 0.0;  ///< of simulated time
  double coverage = 0.0; ///< share, 0 to 1
};

/**
 * Coverage when each place was made.
 * @param made seconds and place, oldest first; metres, world frame
 * @param start, reach as CoverageMeter
 */
std::vector<CoverageSample>
coverageOverTime(const FreeSpace &space, const Eigen::Vector2d &start,
                 const std::vector<std::pair<double, Eigen::Vector2d>> &made, double reach);

} // namespace homeward
