// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/free_space.h>

#include <Eigen/Core>

#include <vector>

namespace homeward
{

/** What one who has the floor plan would drive to cover it. */
struct OracleTour
{
  std::vector<Eigen::Vector2d> places; ///< the start, then in the order of the tour; metres, world
  double length = 0.0;                 ///< metres, from the start to the last place, not back
  double coverage = 0.0;               ///< share of the floor that the places cover
};

/**
 * A tour that covers the floor as the coverage of a map is defined (CoverageMeter).
 *
 * The start is its first place. Of places on reachable floor, one for each square of half a metre,
 * the one that covers most of what is not covered is taken, and again, until 99 % of the floor that
 * any of them covers is covered (judged at one point for each square of 20 cm). Their order is
 * shortOpenTour()'s over the shortest ways on free floor. Neither the choice nor the order is
 * proven best, so this is what a good planner drives who knows everything, not a lower bound.
 * @param start metres, world frame
 * @param reach of one place, metres
 * @throw LogicError when the robot does not fit at the start
 */
OracleTour oracleTour(const FreeSpace &space, const Eigen::Vector2d &start, double reach);

/**
 * A short way from the first of some places through all others, ending anywhere: always to the
 * nearest, then improved by turning parts of it round (2-opt) until none makes it shorter.
 * @param lengths N x N, symmetric: of the way from one to another, metres
 * @return indices, 0 first
 */
std::vector<int> shortOpenTour(const Eigen::MatrixXd &lengths);

} // namespace homeward
