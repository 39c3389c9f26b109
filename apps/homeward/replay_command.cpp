// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "drive_map.h"
#include "explore.h"
#include "navigate.h"
#include "recording.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

/** Those of a map that is made of a drive, and more. */
struct ReplayArguments : DriveMapArguments
{
  bool buildMap = false;
  bool reindex = false;
  bool verbose = false;
  ViewArguments view;
};

int replayExploration(const ReplayArguments &arguments, const nlohmann::json &mission)
{
  if (arguments.map.empty()) {
    throw ConfigError("--map is missing: the file to write the replayed map to");
  }
  ExploreArguments again;
  again.robot.replay = arguments.bag;
  again.map = arguments.map;
  again.settings = exploreSettings(mission.at("settings"));
  again.resume = mission.at("resume").get<bool>();
  again.overwrite = arguments.overwrite;
  again.verbose = arguments.verbose;
  again.view = arguments.view;
  again.json = arguments.json;
  return explore(again);
}

int replayNavigation(const ReplayArguments &arguments, const nlohmann::json &mission)
{
  NavigateArguments again = navigateArguments(mission);
  if (again.refresh && arguments.map.empty()) {
    throw ConfigError("--map is missing: the file to write the refreshed map to");
  }
  again.robot.replay = arguments.bag;
  again.map = arguments.map;
  again.overwrite = arguments.overwrite;
  again.verbose = arguments.verbose;
  again.view = arguments.view;
  again.json = arguments.json;
  return navigate(again);
}

int replay(const ReplayArguments &arguments)
{
  if (arguments.reindex) {
    std::printf("%s\n", repairRecording(arguments.bag).c_str());
    return kExitDone;
  }
  if (arguments.buildMap && arguments.map.empty()) {
    throw ConfigError("--map is missing: the file to write the map to");
  }
  if (arguments.buildMap) {
    return makeDriveMap(arguments);
  }
  const nlohmann::json mission = recordedMission(arguments.bag);
  return mission.at("command") == "explore" ? replayExploration(arguments, mission)
                                            : replayNavigation(arguments, mission);
}

} // namespace

void addReplayCommand(CliCommand app)
{
  auto arguments = std::make_shared<ReplayArguments>();
  CliCommand command =
      app.command("replay", "Run a recorded mission again, from what the robot read then");
  command.examples("Examples: homeward replay drive.bag --map again.hwm\n"
                   "          homeward replay drive.bag --reindex\n"
                   "          homeward replay drive.bag --build-map --map driven.hwm\n"
                   "Exit status 1 says that the robot was told something else than it was then.");
  command.option("bag", arguments->bag, "First bag of a recording").required();
  command.option("--map", arguments->map, "Map file to write");
  command.flag("--overwrite", arguments->overwrite, "Replace an existing map");
  command.flag("--build-map", arguments->buildMap,
               "Make a map of a drive that a person steered; of any bag with pictures, scans and "
               "odometry");
  command
      .option("--forward-distance", arguments->forwardDistance,
              "Of --build-map: metres driven from one place to the next")
      .between(0.5, 20.0)
      .showDefault();
  command.option("--rig", arguments->rig,
                 "Of --build-map: the robot (default: as recorded, else the simulated one)");
  command.option("--image-topic", arguments->imageTopic, "Of --build-map: where the pictures are");
  command.option("--scan-topic", arguments->scanTopic, "Of --build-map: where the scans are");
  command.option("--odometry-topic", arguments->odometryTopic,
                 "Of --build-map: where the odometry is");
  command.flag("--reindex", arguments->reindex,
               "Repair a bag that was not closed, after a kill for example, and do no more");
  command.flag("--verbose", arguments->verbose, "Print every decision");
  addViewOptions(command, arguments->view);
  command.json(arguments->json, "a summary");
  command.run([arguments] { return replay(*arguments); });
}

} // namespace homeward
