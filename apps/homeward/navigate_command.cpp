// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_robot.h"
#include "mission_setup.h"
#include "stop_signal.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/evaluation/truth_log.h>
#include <homeward/homing/homing_method.h>
#include <homeward/mission/navigator.h>
#include <homeward/run/run_mission.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

struct NavigateArguments
{
  RobotArguments robot;
  std::string map;
  std::int64_t to = -1;
  std::int64_t from = -1;
  std::string homing = "minwarping";
  double maxTime = 3600.0;
  bool verbose = false;
  std::string json;
};

void requireNode(const MapFile &file, std::int64_t node)
{
  const TopologicalMap &map = file.map();
  if (!map.contains(NodeId{node})) {
    throw ConfigError("the map " + file.path().string() + " has no node " + std::to_string(node) +
                      "; its nodes are 0 to " + std::to_string(map.nextNodeId().value - 1));
  }
}

/** Where the simulated robot stands: at node `from` with any heading, else where it was left. */
std::optional<Pose2> startPose(const NavigateArguments &arguments,
                               const std::optional<TruthLog> &log)
{
  if (arguments.from < 0) {
    return log ? std::optional(log->end) : std::nullopt;
  }
  if (!log || !log->nodes.contains(NodeId{arguments.from})) {
    throw ConfigError("--from needs " + truthLogFile(arguments.map).string() +
                      ", which says where the nodes truly are; use --start");
  }
  constexpr std::uint32_t kHeadingStream = 77;
  Random random(arguments.robot.simulation.seed, kHeadingStream);
  Pose2 pose = log->nodes.at(NodeId{arguments.from});
  pose.heading = random.uniform(-kPi, kPi);
  return pose;
}

nlohmann::json truthJson(const Pose2 &robot, const Pose2 &goal)
{
  const double error = (robot.translation() - goal.translation()).norm();
  const double turned = std::abs(degrees(wrapAngle(robot.heading - goal.heading)));
  return {{"error_m", error}, {"error_deg", turned}};
}

int navigate(const NavigateArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  const MapFile file = MapFile::open(arguments.map, MapFile::Access::Read);
  requireNode(file, arguments.to);
  if (arguments.from >= 0) {
    requireNode(file, arguments.from);
  }
  const std::optional<TruthLog> log = loadTruthLog(truthLogFile(arguments.map));
  const std::unique_ptr<MissionRobot> robot =
      makeMissionRobot(arguments.robot, startPose(arguments, log));
  const PilotOptions options =
      pilotOptions(robot->files().rig, robot->runsByItself(), arguments.homing);
  file.expectMadeWith(mapHeader(robot->files(), options));
  const Devices devices = robot->devices();
  const Clock &clock = devices.clock;
  const Time start = clock.now();
  const auto seconds = [&] { return toSeconds(clock.now() - start); };
  Pilot pilot(devices, robot->files().robot, robot->files().camera, options, stopSignal());
  if (arguments.verbose) {
    pilot.trace = [&](const std::string &line) {
      std::printf("  # %.1f s %s\n", seconds(), line.c_str());
    };
  }
  rememberAll(file, pilot);

  const Navigator navigator({});
  MissionCounts counts;
  std::vector<NodeId> visited;
  const auto enough = [&] { return seconds() > arguments.maxTime; };
  const auto onStep = [&](const Step<NavigatorState> &step) {
    endProgress();
    for (const std::string &line : step.log) {
      std::printf("%s\n", line.c_str());
    }
    std::fflush(stdout);
    visited = step.state.visited;
    showProgress("robot time " + std::to_string(std::lround(seconds())) + " s");
  };
  const Finish finish = runMission(navigator, navigator.start(file.map(), NodeId{arguments.to}),
                                   pilot, file.map(), nullptr, clock, counts, enough, onStep);
  endProgress();

  nlohmann::json json = jsonHeader("navigate");
  json["seed"] = robot->world().value_or(SimulatedWorld{}).seed;
  json["outcome"] = name(finish.outcome);
  json["reason"] = finish.reason;
  json["sim_time_s"] = seconds();
  json["path"] = nlohmann::json::array();
  for (const NodeId node : visited) {
    json["path"].push_back(node.value);
  }
  std::printf("%s: %s, robot time %.0f s\n", name(finish.outcome), finish.reason.c_str(),
              seconds());
  const std::optional<Truth> truth = robot->truth();
  if (truth && log && log->nodes.contains(NodeId{arguments.to})) {
    json["truth"] = truthJson(truth->pose, log->nodes.at(NodeId{arguments.to}));
    std::printf("truth: %.2f m and %.0f degrees from where the node was made\n",
                json["truth"]["error_m"].get<double>(), json["truth"]["error_deg"].get<double>());
  }
  if (truth) {
    json["collisions"] = truth->collisions;
    json["unseen_contacts"] = truth->unseenContacts;
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(arguments.json, json);
  return finish.outcome == Outcome::Done ? kExitDone : kExitFailed;
}

} // namespace

void addNavigateCommand(CliCommand app)
{
  auto arguments = std::make_shared<NavigateArguments>();
  CliCommand command = app.command("navigate", "Drive to a node of a map by sight");
  command.examples("Example: homeward navigate --map lab.hwm --world data/worlds/lab.sdf --to 3\n"
                   "Without --start or --from the simulated robot stands where it was left.");
  addRobotArguments(command, arguments->robot);
  command.option("--map", arguments->map, "Map file").required();
  command.option("--to", arguments->to, "Node to drive to").required();
  command.option("--from", arguments->from, "Start at this node's true place, any heading");
  command
      .option("--homing", arguments->homing, "How the robot finds home by sight; hiss as the seed")
      .oneOf(homingMethodNames())
      .showDefault();
  command.option("--max-time", arguments->maxTime, "Seconds of robot time after which it gives up")
      .positive()
      .showDefault();
  command.flag("--verbose", arguments->verbose, "Print every decision");
  command.json(arguments->json, "a summary");
  command.run([arguments] { return navigate(*arguments); });
}

} // namespace homeward
