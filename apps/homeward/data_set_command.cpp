// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_setup.h"
#include "view_source.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{

ViewSource viewSource(const SimulatedRobot &robot, const SimulationArguments &arguments)
{
  ViewSource source{robot.sharedScene(), robot.robot().rMp, robot.camera()};
  source.seed = arguments.seed;
  source.rendering.threads = arguments.threads;
  return source;
}

void addSceneChange(CliCommand command, SceneChange &change)
{
  command.option("--people", change.people, "People who stand about in a world").between(1, 1000);
  command.option("--move-furniture", change.moveFurniture, "Metres that its chairs are moved")
      .between(0.01, 10.0);
}

void applyChange(ViewSource &source, const SimulatedRobot &robot, const std::vector<Pose2> &views,
                 const SceneChange &change)
{
  if (change.people == 0 && !(change.moveFurniture > 0.0)) {
    return;
  }
  ChangedScene changed =
      changeScene(robot.scene(), robot.simulator().freeSpace(), views, change, source.seed);
  std::printf("changed: %zu people, %zu pieces of furniture moved\n", changed.people,
              changed.moved.size());
  source.scene = std::make_shared<const Scene>(std::move(changed.scene));
}

Progress renderProgress()
{
  return [](std::size_t done, std::size_t all) {
    showProgress("pictures " + std::to_string(done) + " of " + std::to_string(all));
    if (done == all) {
      endProgress();
    }
  };
}

namespace
{

struct DataSetArguments
{
  SimulationArguments simulation;
  std::string output;
  std::string json;
  std::vector<std::string> lights{"day"};
  double spacing = 0.5;
  std::size_t count = 0;
  SceneChange change;
  bool exactOptics = false;
  bool gray = false;
};

void makeDataSet(const DataSetArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  std::vector<LightPreset> lights;
  for (const std::string &light : arguments.lights) {
    lights.push_back(parseLightPreset(light));
  }
  SimulatedRobot robot(arguments.simulation);
  const FreeSpace &space = robot.simulator().freeSpace();
  const std::uint64_t seed = arguments.simulation.seed;
  const std::vector<Pose2> poses = arguments.count > 0 ? randomPoses(space, arguments.count, seed)
                                                       : gridPoses(space, arguments.spacing, seed);
  ViewSource source = viewSource(robot, arguments.simulation);
  source.exactOptics = arguments.exactOptics;
  source.colour = !arguments.gray;
  applyChange(source, robot, poses, arguments.change);
  DataSet set(robot.camera());
  for (const LightPreset light : lights) {
    addRenderedViews(set, source, poses, light, renderProgress());
  }
  set.write(arguments.output);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  nlohmann::json json = jsonHeader("evaluate data-set");
  json["seed"] = seed;
  json["wall_time_s"] = wall.count();
  json["folder"] = arguments.output;
  json["pictures"] = set.size();
  json["places"] = poses.size();
  writeJson(arguments.json, json);
  std::printf("%s: %zu pictures at %zu places\n", arguments.output.c_str(), set.size(),
              poses.size());
}

} // namespace

void addDataSetCommand(CliCommand evaluate)
{
  auto arguments = std::make_shared<DataSetArguments>();
  CliCommand command =
      evaluate.command("data-set", "Write pictures of a world and where they were taken");
  command.examples("Example: homeward evaluate data-set --world house.world --spacing 0.6 "
                   "--lights day night -o house");
  addSimulationArguments(command, arguments->simulation);
  command.remove("--light");
  command.option("-o,--output", arguments->output, "Folder to write").required();
  command.option("--lights", arguments->lights, "Light presets, each at the same places")
      .showDefault();
  command.option("--spacing", arguments->spacing, "Metres between places of a grid")
      .between(0.05, 20.0)
      .showDefault();
  command.option("--count", arguments->count, "Random places instead of a grid, so many")
      .between(1, 100000);
  addSceneChange(command, arguments->change);
  command.flag("--exact-optics", arguments->exactOptics,
               "The mirror is exactly as the camera file says");
  command.flag("--gray", arguments->gray, "Gray instead of colour");
  command.json(arguments->json, "a summary");
  command.run([arguments] {
    makeDataSet(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
