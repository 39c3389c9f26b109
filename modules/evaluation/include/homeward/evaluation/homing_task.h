// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/dataset/data_set.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace homeward
{

/** A place to find home from, and the home; indices of the task's views and homes. */
struct HomingPair
{
  std::size_t view = 0; ///< index of HomingTask::viewPoses
  std::size_t home = 0; ///< index of HomingTask::homePoses
};

/** Whether two points of the floor, metres, are in sight of each other. */
using Sees = std::function<bool(const Eigen::Vector2d &, const Eigen::Vector2d &)>;

/** Which pairs are compared. */
struct HomingPairOptions
{
  double nearest = 0.3;    ///< metres apart, at least
  double farthest = 2.5;   ///< metres apart, at most
  std::size_t pairs = 500; ///< homes are added until there are as many, while there are any
  std::size_t fewest = 4;  ///< homes with fewer views around them are passed over
};

/**
 * Pairs of each view and each home between the two distances and in sight of each other, homes in
 * their order, all pairs of a home or none.
 * @throw LogicError unless 0 < nearest < farthest
 */
std::vector<HomingPair> chooseHomingPairs(const std::vector<Pose2> &views,
                                          const std::vector<Pose2> &homes, const Sees &sees,
                                          const HomingPairOptions &options = {});

/** Homing to find: views, homes and their pairs. The robot's mirror stands over its middle. */
struct HomingTask
{
  std::vector<Pose2> viewPoses; ///< where views were taken, world frame
  std::vector<Pose2> homePoses; ///< where homes are, world frame
  std::function<Panorama(std::size_t)>
      viewPanorama; ///< of a place, safe to call from several threads
  std::function<Panorama(std::size_t)> homePanorama; ///< of a home, by index
  std::vector<HomingPair> pairs;                     ///< pairs of one home stand together

  /** Bearing of the pair's home in the view's robot frame, radians. */
  double trueDirection(const HomingPair &pair) const;

  /** heading(view) - heading(home), radians. */
  double trueHeadingChange(const HomingPair &pair) const;
};

/**
 * A task over a data set: homes from the views of `mapLight`, views from those of `nowLight`.
 * @param set must outlive the task
 * @param seed of the order in which homes are taken
 * @throw ConfigError naming a light that the set does not have
 */
HomingTask homingTask(const DataSet &set, const std::string &mapLight, const std::string &nowLight,
                      const Sees &sees, std::uint64_t seed, const HomingPairOptions &options = {});

} // namespace homeward
