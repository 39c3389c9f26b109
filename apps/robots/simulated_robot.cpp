// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulated_robot.h"

#include "files.h"

#include <homeward/core/error.h>

#include <cstdio>

namespace homeward
{
namespace fs = std::filesystem;

void addSimulationArguments(CliCommand command, SimulationArguments &arguments)
{
  command.option("--world", arguments.world, "SDF world to simulate (default: the laboratory)");
  command.option("--rig", arguments.rig, "Rig file: robot, camera, limits (YAML)");
  command.option("--start", arguments.start, "Start as x,y,heading in metres and radians");
  command.option("--light", arguments.light, "day, twilight, night or two_lamps").showDefault();
  command.option("--seed", arguments.seed, "Seed of everything random").showDefault();
  command.option("--threads", arguments.threads, "Threads that render pictures")
      .between(1, 64)
      .showDefault();
}

Pose2 parsePose(const std::string &text)
{
  Pose2 pose;
  char rest = 0;
  const int read =
      std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &pose.x, &pose.y, &pose.heading, &rest);
  if (read != 3 || !std::isfinite(pose.x + pose.y + pose.heading)) {
    throw ConfigError("start '" + text + "' is not x,y,heading, for example 1.5,-2,0.8");
  }
  pose.heading = wrapAngle(pose.heading);
  return pose;
}

SimulatedRobot::SimulatedRobot(const SimulationArguments &arguments, std::optional<Pose2> start)
    : m_files(loadRobotFiles(arguments.rig))
{
  SimulatorOptions options;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.laser = arguments.laser;
  options.light = parseLightPreset(arguments.light);
  if (!arguments.start.empty()) {
    start = parsePose(arguments.start);
  }
  const fs::path world =
      arguments.world.empty() ? shippedFile("worlds/lab.sdf") : fs::path(arguments.world);
  m_worldFile = world.string();
  m_scene = std::make_shared<const Scene>(loadScene(world));
  for (const std::string &problem : m_scene->problems) {
    std::fprintf(stderr, "homeward: %s: %s\n", world.filename().c_str(), problem.c_str());
  }
  options.start = start;
  m_simulator = std::make_unique<Simulator>(m_scene, m_files.robot, m_files.camera, options);
}

Devices SimulatedRobot::devices()
{
  return {m_simulator->clock(), m_simulator->base(), m_simulator->laser(), m_simulator->camera()};
}

} // namespace homeward
