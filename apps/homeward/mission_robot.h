// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robot_files.h"
#include "simulated_robot.h"

#include <homeward/pilot/motion.h>
#include <homeward/sim/simulator.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>

namespace homeward
{

class RealRobot;

/** What is known of the world that a simulated robot stands in. */
struct SimulatedWorld
{
  std::string world; ///< SDF file
  std::string light; ///< preset's name
  std::uint64_t seed = 1;
};

/** A robot for a mission, simulated or real. What only a simulator knows is for evaluation. */
class MissionRobot
{
public:
  virtual ~MissionRobot() = default;

  virtual Devices devices() = 0;
  virtual const RobotFiles &files() const = 0;

  /** Whether time goes on while nobody asks for it. */
  virtual bool runsByItself() { return real() != nullptr; }

  /** The robot of a rig with devices; null in simulation. */
  virtual RealRobot *real() = 0;

  /** The time, for people: a look at it is not recorded. */
  virtual Time watch() { return devices().clock.now(); }

  /** Of a recorded robot that is replayed: whether the mission went on from here. */
  virtual bool wentOn() { return false; }

  /** Something for the recording, where there is one. */
  virtual void note(const nlohmann::json & /*event*/) {}

  /**
   * Ends a recording or a replay and says what it came to.
   * @param summary gets a key for it
   * @return false when a replayed mission told its robot something else than it did then
   */
  virtual bool finish(nlohmann::json & /*summary*/) { return true; }

  virtual std::optional<SimulatedWorld> world() const = 0;
  virtual std::optional<Truth> truth() const = 0;

  /** Of the world; null where the truth is not known. */
  virtual const FreeSpace *freeSpace() = 0;
};

/** Where a mission is recorded. */
struct RecordArguments
{
  std::string file;               ///< ROS 1 bag; empty: nowhere
  double splitMegabytes = 1000.0; ///< of a bag, after which the next one begins
};

/** Which robot a mission is for. */
struct RobotArguments
{
  SimulationArguments simulation; ///< its rig may be a real one
  double clockRate = 0.0;         ///< 0: as the rig says
  std::string truth;              ///< URL of what pioneer-sim knows; empty: nothing is known
  std::string joystick;           ///< stops the robot; empty: as the rig says
  int reconnect = 8;              ///< tries to bring a lost base back; 0: a fault ends the mission
  RecordArguments record;
  std::string replay;       ///< a recording instead of a robot; no option
  std::size_t restless = 0; ///< people who walk about while chairs get moved; 0: all is quiet
};

/** `--restless N`. */
void addRestless(CliCommand command, std::size_t &people);

void addRobotArguments(CliCommand command, RobotArguments &arguments);

/**
 * Connects to the devices that the rig names, or simulates where it names none; records it, or
 * replays one that was recorded, where the arguments say so.
 * @param start of a simulated robot when no --start was given
 * @param mission its command and settings, for a recording
 * @throw ConfigError when a file or an option is wrong, DeviceError when a device does not answer
 */
std::unique_ptr<MissionRobot> makeMissionRobot(const RobotArguments &arguments,
                                               std::optional<Pose2> start = std::nullopt,
                                               const nlohmann::json &mission = {});

} // namespace homeward
