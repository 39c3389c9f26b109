// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/random.h>
#include <homeward/core/scan.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/solid_world.h>

#include <utility>
#include <vector>

namespace homeward
{

/** What a laser looks at, and how well. */
struct LaserOptions
{
  double fieldOfView = kPi;   ///< radians, centred on forward, at most a full turn
  double step = radians(1.0); ///< radians between readings
  double rangeMax = 15.0;     ///< metres; beyond it reads exactly this: far and open
  double sigma = 0.01;        ///< standard deviation of a range, metres
  double dropOutRate = 0.002; ///< share of readings that are unknown (dark, grazing)
  double faultRate = 0.0003;  ///< share of readings that are nonsense, half each:
  double nearFault = 0.05;    ///< below this many metres, or ...
  double farFault = 32.0;     ///< ... about this many, above rangeMax
};

/**
 * A SICK laser in a world. It sees the collision geometry, as Gazebo's does: that is what the body
 * runs into, and decoration without a body is nothing to avoid. Its own robot is invisible to it.
 */
class LaserModel
{
public:
  /**
   * @throw LogicError unless 0 < step <= fieldOfView <= 2 pi, rangeMax > 0 and the rest >= 0
   */
  LaserModel(SolidWorld world, const Eigen::Isometry3d &rMl, const LaserOptions &options,
             std::uint64_t seed);

  /** From now on it looks at another world. */
  void setWorld(SolidWorld world) { m_world = std::move(world); }

  /** One sweep from where the robot stands. */
  Scan measure(Time stamp, const Pose2 &wMr);

private:
  float read(double range);

  SolidWorld m_world;
  Eigen::Isometry3d m_rMl;
  LaserOptions m_options;
  std::vector<Eigen::Vector3d> m_rays; ///< directions in the laser's frame
  Random m_random;
};

} // namespace homeward
