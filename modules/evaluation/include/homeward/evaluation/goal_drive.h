// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/restless_world.h>
#include <homeward/evaluation/truth_log.h>
#include <homeward/mission/navigator.h>
#include <homeward/pilot/pilot.h>
#include <homeward/sim/simulator.h>
#include <homeward/store/map_file.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** The node that a robot believed to stand at first, after it had been switched on. */
struct FirstPlace
{
  NodeId node;          ///< that it believed to stand at
  double error = 0.0;   ///< metres from where that node was made, when it believed so
  double seconds = 0.0; ///< simulated, since it was switched on

  /** Whether it stood there indeed, within 0.3 m. */
  bool right() const;
};

/** One drive to a node of a finished map, by a robot that does not know where it stands. */
struct GoalDrive
{
  std::optional<NodeId> from;        ///< the node it was put at; nothing when put anywhere
  NodeId goal;                       ///< where it was sent
  Pose2 start;                       ///< world frame
  Outcome outcome = Outcome::Failed; ///< how the navigation ended
  std::string reason;                ///< why, in words
  double error = 0.0;                ///< metres from where the goal was made, at the end
  double headingError = 0.0;         ///< radians, >= 0, likewise
  double distance = 0.0;             ///< driven, metres
  double seconds = 0.0;              ///< simulated
  int collisions = 0;                ///< see Truth
  int unseenContacts = 0;            ///< see Truth
  std::optional<FirstPlace> first;   ///< nothing when it never knew

  /** Whether it said so and was within 0.3 m of where the goal was made. */
  bool arrived() const;
};

/** Who drives, and with what settings. */
struct GoalDriver
{
  Simulator &simulator;              ///< the robot and its world
  const RobotDescription &robot;     ///< its shape
  const MirrorCamera &camera;        ///< nominal, what the robot believes of it
  const PilotOptions &pilot;         ///< of the pilot that drives
  const NavigatorOptions &navigator; ///< of the decisions
  RestlessWorld *restless = nullptr; ///< what goes on in the simulated world; null: it is quiet
  double maxTime = 3600.0;           ///< simulated s after which a drive is given up
};

/**
 * One drive, from where the robot stands, with a pilot that has just been switched on.
 * @param onStep called with every state of the navigation, before its command is carried out
 */
GoalDrive driveToGoal(const GoalDriver &driver, const MapFile &file, const TruthLog &truth,
                      NodeId goal, const std::atomic<bool> &stop,
                      const std::function<void(const NavigatorState &)> &onStep = {});

/**
 * Drives to random nodes from other random nodes where it fits, in random headings.
 * @param file the finished map
 * @param truth where its nodes truly are
 * @param seed of nodes and headings; of two counts, the larger begins with the smaller
 * @param stop ends the drives; those that were driven to their end are returned
 * @return nothing on a map of fewer than two nodes
 */
std::vector<GoalDrive> driveToGoals(const GoalDriver &driver, const MapFile &file,
                                    const TruthLog &truth, std::size_t count, std::uint64_t seed,
                                    const std::atomic<bool> &stop);

/**
 * The same from anywhere on the reachable floor where there is room to turn: a robot that was
 * carried off, switched on and sent to a random node. It has to find out where it is.
 */
std::vector<GoalDrive> driveAfterKidnappings(const GoalDriver &driver, const MapFile &file,
                                             const TruthLog &truth, std::size_t count,
                                             std::uint64_t seed, const std::atomic<bool> &stop);

} // namespace homeward
