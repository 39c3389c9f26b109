// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"
#include "robot_files.h"

#include <homeward/pilot/motion.h>
#include <homeward/sim/simulator.h>

#include <memory>
#include <optional>
#include <string>

namespace homeward
{

/** Which robot stands in which world; what explore and navigate have in common. */
struct SimulationArguments
{
  std::string world;
  std::string rig;
  std::string start; ///< "x,y,heading" in metres and radians; empty chooses
  std::string light = "day";
  std::uint64_t seed = 1;
  int threads = 2;
  LaserOptions laser = {}; ///< no option of the command line
};

void addSimulationArguments(CliCommand command, SimulationArguments &arguments);

/** "x,y,heading". @throw ConfigError */
Pose2 parsePose(const std::string &text);

/** A robot in a world, built from files. */
class SimulatedRobot
{
public:
  /**
   * @param start overrides the start when no --start was given
   * @throw ConfigError when a file is missing or wrong, or the start is in a wall
   */
  explicit SimulatedRobot(const SimulationArguments &arguments,
                          std::optional<Pose2> start = std::nullopt);

  Devices devices();
  Simulator &simulator() const { return *m_simulator; }
  const Scene &scene() const { return *m_scene; }
  const std::shared_ptr<const Scene> &sharedScene() const { return m_scene; }
  const RobotFiles &files() const { return m_files; }
  const RobotDescription &robot() const { return m_files.robot; }
  const MirrorCamera &camera() const { return m_files.camera; }
  const std::string &worldFile() const { return m_worldFile; }

private:
  RobotFiles m_files;
  std::string m_worldFile;
  std::shared_ptr<const Scene> m_scene;
  std::unique_ptr<Simulator> m_simulator;
};

} // namespace homeward
