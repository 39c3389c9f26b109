// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/place/bayes_localizer.h>
#include <homeward/place/signature.h>
#include <homeward/sim/free_space.h>

#include <cstdint>
#include <vector>

namespace homeward
{

/** Pictures on a straight drive, and known ones on rows parallel to it. \cite Thesis, ch. 3.5 */
struct RowOptions
{
  std::size_t seen = 16;     ///< pictures of the drive
  double seenSpacing = 0.3;  ///< metres
  std::size_t known = 6;     ///< pictures of a row
  double knownSpacing = 0.9; ///< metres
  std::vector<double> distances{0.0, 0.3, 0.6, 0.9,
                                1.2, 1.5, 1.8}; ///< of rows to the drive, metres
};

/** Where the pictures of one drive and of its rows are taken. */
struct RowPoses
{
  std::vector<Pose2> seen;               ///< on the drive, world frame
  std::vector<std::vector<Pose2>> known; ///< by distance; empty where the row stands in something
};

/**
 * Straight drives over reachable floor, anywhere and in any direction, with the rows on the side
 * where more of them are on reachable floor too.
 * @param count how many; fewer when the world has no room for them
 */
std::vector<RowPoses> placeRows(const FreeSpace &space, std::size_t count, std::uint64_t seed,
                                const RowOptions &options = {});

/**
 * Share of a drive's pictures for which the most probable known one is the nearest.
 * @param known, seen signatures of one kind, in the order of the poses
 */
double rowSuccess(const std::vector<Pose2> &knownPoses, const std::vector<Signature> &known,
                  const std::vector<Pose2> &seenPoses, const std::vector<Signature> &seen,
                  const BayesOptions &options);

} // namespace homeward
