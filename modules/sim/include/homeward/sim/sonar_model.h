// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/random.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/solid_world.h>

#include <utility>
#include <vector>

namespace homeward
{

/**
 * The sonars of a Pioneer in a world: each hears the nearest thing above the floor in a cone of 30
 * degrees, up to 5 m, with an error of 1 cm. Sound that a slanting wall throws aside is not
 * modelled.
 */
class SonarModel
{
public:
  static constexpr double kRangeMax = 5.0; ///< metres

  /** @param seed of the noise */
  SonarModel(SolidWorld world, const RobotDescription &robot, std::uint64_t seed);

  /** From now on it hears another world. */
  void setWorld(SolidWorld world) { m_world = std::move(world); }

  /** The echo of every transducer from where the robot stands. */
  std::vector<SonarEcho> measure(const Pose2 &wMr);

private:
  double nearest(const SonarMount &mount, const Eigen::Isometry3d &wMr) const;

  SolidWorld m_world;
  std::vector<SonarMount> m_mounts;
  Random m_random;
};

} // namespace homeward
