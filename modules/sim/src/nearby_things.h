// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/collision_map.h>

#include <memory>
#include <optional>

namespace homeward
{

/**
 * What the robot's body meets of the things that come and go: a map of those near it, which is
 * drawn in well under a millisecond where one of the whole world takes tens.
 */
class NearbyThings
{
public:
  explicit NearbyThings(RobotDescription robot) : m_robot(std::move(robot)) {}

  /** Instead of the things put before. */
  void put(std::shared_ptr<const Scene> things);

  /** Of the things that the body could touch at `wMr`; null where there are none. */
  std::shared_ptr<const CollisionMap> around(const Pose2 &wMr);

private:
  RobotDescription m_robot;
  std::shared_ptr<const Scene> m_things;
  std::optional<Eigen::Vector2d> m_middle; ///< of what m_map covers, metres
  std::shared_ptr<const CollisionMap> m_map;
};

} // namespace homeward
