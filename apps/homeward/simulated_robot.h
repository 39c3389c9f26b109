// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>
#include <homeward/pilot/motion.h>
#include <homeward/robot/rig.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/simulator.h>

#include <CLI/CLI.hpp>

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
};

void addSimulationArguments(CLI::App &command, SimulationArguments &arguments);

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
  Simulator &simulator() { return *m_simulator; }
  const Scene &scene() const { return *m_scene; }
  const std::shared_ptr<const Scene> &sharedScene() const { return m_scene; }
  const RobotDescription &robot() const { return m_robot; }
  const MirrorCamera &camera() const { return m_camera; }
  const Limits &limits() const { return m_rig.limits; }
  const std::string &cameraText() const { return m_cameraText; }
  const std::string &robotFile() const { return m_robotFile; }

private:
  Rig m_rig;
  std::string m_robotFile;
  RobotDescription m_robot;
  std::string m_cameraText;
  MirrorCamera m_camera;
  std::shared_ptr<const Scene> m_scene;
  std::unique_ptr<Simulator> m_simulator;
};

} // namespace homeward
