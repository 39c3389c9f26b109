// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/rendered_views.h>
#include <homeward/pilot/pilot.h>
#include <homeward/sim/simulator.h>

#include <vector>

namespace homeward
{

/** Which drives home are tried. */
struct ArrivalOptions
{
  std::size_t runs = 200;                  ///< how many
  double nearest = 0.3;                    ///< metres from home, at least
  double farthest = 2.5;                   ///< metres from home, at most
  std::uint64_t seed = 1;                  ///< of homes, starts and headings
  LightPreset mapLight = LightPreset::Day; ///< when homes were seen
  LightPreset nowLight = LightPreset::Day; ///< when the robot drives home
  double proxyFactor = 1.0;                ///< distance proxies come out so many times too large
  int threads = 2;                         ///< that render
};

/** One drive home. */
struct ArrivalRun
{
  Pose2 home;                          ///< the robot when home was seen, world frame
  Pose2 start;                         ///< likewise
  Pose2 end;                           ///< likewise
  HomingEnd outcome = HomingEnd::Lost; ///< as the homing said
  double seconds = 0.0;                ///< simulated
  int collisions = 0;                  ///< see Truth
  std::vector<Eigen::Vector2d> way;    ///< world, metres

  double error() const;        ///< metres from home at the end
  double headingError() const; ///< radians, >= 0
  bool arrived() const;        ///< said so, and is within 0.3 m of it
};

/** All drives together. */
struct ArrivalScore
{
  std::size_t runs = 0;           ///< tried
  std::size_t arrived = 0;        ///< by what the homing said
  std::size_t wronglyArrived = 0; ///< said so, and is elsewhere
  double medianError = 0.0;       ///< metres, of those that arrived
  double medianHeadingDeg = 0.0;  ///< degrees, of those that arrived
  double medianSeconds = 0.0;     ///< simulated, of those that arrived
  int collisions = 0;             ///< of all runs
};

/**
 * Drives home by sight from random places that see it, each with a pilot that knows this home only.
 * At both ends there is room to turn.
 * @param nominal what the robot believes of its camera
 * @throw ConfigError when the world has no such places
 */
std::vector<ArrivalRun> driveHome(const std::shared_ptr<const Scene> &scene,
                                  const RobotDescription &robot, const MirrorCamera &nominal,
                                  const PilotOptions &pilot, const ArrivalOptions &options,
                                  const Progress &progress = {});

/** Counts and middles of runs. */
ArrivalScore scoreArrivals(const std::vector<ArrivalRun> &runs);

} // namespace homeward
