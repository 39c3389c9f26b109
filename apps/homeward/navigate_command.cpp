// SPDX-License-Identifier: GPL-3.0-or-later
#include "navigate.h"

#include "command.h"
#include "files.h"
#include "mission_setup.h"
#include "navigation_goals.h"
#include "operated.h"
#include "recording.h"
#include "stop_signal.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/evaluation/truth_log.h>
#include <homeward/homing/homing_method.h>
#include <homeward/record/replayed_devices.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <deque>
#include <functional>
#include <memory>

namespace homeward
{
namespace
{

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

/** What became of one drive, and how far from its goal the robot stood if somebody knows. */
struct Visit
{
  NavigationGoal goal;
  GoalReport report;
  std::optional<Pose2> robot; ///< true, at the end
  std::optional<Pose2> place; ///< true, of the goal
};

/** The visits of a navigation, of a long one the latest. */
struct Visits
{
  static constexpr std::size_t kKept = 1000;
  std::deque<Visit> kept;
  int tried = 0;
  int reached = 0;
  int refreshed = 0; ///< pictures

  void add(const Visit &visit)
  {
    ++tried;
    reached += visit.report.outcome == Outcome::Done ? 1 : 0;
    refreshed += visit.report.refreshed ? 1 : 0;
    kept.push_back(visit);
    if (kept.size() > kKept) {
      kept.pop_front();
    }
  }
};

nlohmann::json truthJson(const Visit &visit)
{
  const Pose2 off = visit.place->inverse() * *visit.robot;
  return {{"error_m", off.translation().norm()}, {"error_deg", std::abs(degrees(off.heading))}};
}

/** Nodes of the map alone: where a picture was taken is none. */
nlohmann::json pathJson(const GoalReport &report, const TopologicalMap &map)
{
  nlohmann::json path = nlohmann::json::array();
  for (const NodeId node : report.path) {
    if (map.contains(node)) {
      path.push_back(node.value);
    }
  }
  return path;
}

nlohmann::json visitJson(const Visit &visit, const TopologicalMap &map)
{
  nlohmann::json json{{"goal", visit.goal.word},
                      {"node", visit.goal.node.value},
                      {"outcome", name(visit.report.outcome)},
                      {"reason", visit.report.reason},
                      {"sim_time_s", visit.report.seconds},
                      {"path", pathJson(visit.report, map)},
                      {"refreshed", visit.report.refreshed}};
  if (visit.goal.shown) {
    json["node"] = visit.goal.shown->node.value;
    json["probability"] = visit.goal.shown->probability;
  }
  if (visit.robot) {
    json["true_x_m_y_m_heading_rad"] = {visit.robot->x, visit.robot->y, visit.robot->heading};
  }
  if (visit.place && visit.robot) {
    json.update(truthJson(visit));
  }
  return json;
}

void print(const Visit &visit)
{
  std::printf("%s: %s, robot time %.0f s%s\n", name(visit.report.outcome),
              visit.report.reason.c_str(), visit.report.seconds,
              visit.report.refreshed ? ", picture refreshed" : "");
  if (visit.place && visit.robot) {
    const nlohmann::json truth = truthJson(visit);
    std::printf("truth: %.2f m and %.0f degrees from where the node was made\n",
                truth["error_m"].get<double>(), truth["error_deg"].get<double>());
  }
  std::fflush(stdout);
}

void sayWhatPicturesShow(const std::vector<NavigationGoal> &goals)
{
  for (const NavigationGoal &goal : goals) {
    if (goal.shown) {
      std::printf("%s shows node %lld, probability %.2f\n", goal.word.c_str(),
                  static_cast<long long>(goal.shown->node.value), goal.shown->probability);
    }
  }
}

/** The drive of a replay on which there is nothing more. */
GoalReport endedAt(NodeId goal, const RuntimeError &why)
{
  GoalReport report;
  report.goal = goal;
  report.outcome = Outcome::Stopped;
  report.reason = why.what();
  return report;
}

/** Drives to the goals in turn, over and over, until somebody stops it. */
Visits visitInTurn(const NavigateArguments &arguments, const std::vector<NavigationGoal> &goals,
                   Navigation &navigation, MissionRobot &robot, const std::optional<TruthLog> &log)
{
  const std::unique_ptr<OperatorInput> hands = makeOperator(robot, arguments.robot);
  const auto driveTo = [&](NodeId node) -> GoalReport {
    try {
      return runOperated(robot, hands.get(), arguments.robot,
                         [&] { return navigation.driveTo(node, arguments.maxTime); });
    }
    catch (const RecordingEnded &end) {
      return endedAt(node, end);
    }
    catch (const DeviceError &fault) {
      if (arguments.robot.replay.empty()) {
        throw;
      }
      return endedAt(node, fault); // as then
    }
  };
  Visits visits;
  for (int round = 0; arguments.repeat == 0 || round < arguments.repeat; ++round) {
    for (const NavigationGoal &goal : goals) {
      Visit visit{goal, driveTo(goal.node), {}, {}};
      endProgress();
      if (const std::optional<Truth> truth = robot.truth()) {
        visit.robot = truth->pose;
      }
      if (log && log->nodes.contains(goal.node)) {
        visit.place = log->nodes.at(goal.node);
      }
      print(visit);
      visits.add(visit);
      if (visit.report.outcome == Outcome::Stopped) {
        return visits;
      }
    }
  }
  return visits;
}

/**
 * Does what is wanted at the page until Ctrl-C.
 * @param drive to a goal, or to all that were given once more
 */
void serve(Dashboard &dashboard, MapFile &file, bool replayed, Visits &visits,
           const std::function<Visits(std::optional<NodeId> goal)> &drive)
{
  while (true) {
    const GoalReport &last = visits.kept.back().report;
    const std::string words = std::string(name(last.outcome)) + ": " + last.reason;
    std::printf("%s; Ctrl-C ends the page\n", words.c_str());
    std::fflush(stdout);
    const bool resumable = last.outcome == Outcome::Stopped && !replayed;
    const NextDrive next = dashboard.await(file, words, resumable);
    if (next.kind == NextDrive::Kind::End) {
      return;
    }
    const bool goes = next.kind == NextDrive::Kind::GoTo;
    for (const Visit &visit : drive(goes ? std::optional(next.goal) : std::nullopt).kept) {
      visits.add(visit);
    }
  }
}

/** The outcome of all visits as that of one: what the JSON of a navigation says. */
Finish conclude(const Visits &visits, bool patrol)
{
  const GoalReport &last = visits.kept.back().report;
  if (!patrol) {
    return {last.outcome, last.reason};
  }
  const Outcome missed = last.outcome == Outcome::Stopped ? last.outcome : Outcome::Failed;
  return {visits.reached == visits.tried ? Outcome::Done : missed,
          std::to_string(visits.reached) + " of " + std::to_string(visits.tried) +
              " goals reached"};
}

nlohmann::json summary(const Visits &visits, const Finish &finish, const TopologicalMap &map,
                       const MissionRobot &robot)
{
  nlohmann::json json = jsonHeader("navigate");
  json["seed"] = robot.world().value_or(SimulatedWorld{}).seed;
  json["outcome"] = name(finish.outcome);
  json["reason"] = finish.reason;
  json["path"] = nlohmann::json::array();
  json["goals"] = nlohmann::json::array();
  for (const Visit &visit : visits.kept) {
    const nlohmann::json goal = visitJson(visit, map);
    json["path"].insert(json["path"].end(), goal["path"].begin(), goal["path"].end());
    json["goals"].push_back(goal);
  }
  json["goals_tried"] = visits.tried;
  json["goals_reached"] = visits.reached;
  json["refreshed"] = visits.refreshed;
  const Visit &last = visits.kept.back();
  if (last.place && last.robot) {
    json["truth"] = truthJson(last);
  }
  if (const std::optional<Truth> truth = robot.truth()) {
    json["collisions"] = truth->collisions;
    json["unseen_contacts"] = truth->unseenContacts;
  }
  return json;
}

/** Says how it went. @return exit status */
int report(const NavigateArguments &arguments, const Visits &visits, bool patrol,
           const TopologicalMap &map, MissionRobot &robot, double robotSeconds, double wallSeconds)
{
  const Finish finish = conclude(visits, patrol);
  if (patrol) {
    std::printf("%s: %s, robot time %.0f s\n", name(finish.outcome), finish.reason.c_str(),
                robotSeconds);
  }
  if (arguments.refresh) {
    std::printf("%d pictures refreshed\n", visits.refreshed);
  }
  nlohmann::json json = summary(visits, finish, map, robot);
  json["sim_time_s"] = robotSeconds;
  json["wall_time_s"] = wallSeconds;
  const bool same = robot.finish(json);
  writeJson(arguments.json, json);
  if (!arguments.robot.replay.empty()) {
    return same ? kExitDone : kExitFailed;
  }
  return finish.outcome == Outcome::Done ? kExitDone : kExitFailed;
}

/** What a replay must know. */
nlohmann::json mission(const NavigateArguments &arguments)
{
  return {{"command", "navigate"},         {"to", arguments.to},
          {"repeat", arguments.repeat},    {"homing", arguments.homing},
          {"max_time", arguments.maxTime}, {"refresh", arguments.refresh}};
}

/** The map to drive in; of a replay the one that was driven in, or a copy to refresh. */
MapFile openMap(const NavigateArguments &arguments)
{
  if (!arguments.robot.replay.empty()) {
    MapFile before = MapFile::open(mapBefore(arguments.robot.replay), MapFile::Access::Read);
    return arguments.refresh ? MapFile::copyOf(before, arguments.map,
                                               arguments.overwrite ? MapFile::IfExists::Replace
                                                                   : MapFile::IfExists::Refuse)
                             : std::move(before);
  }
  const bool changes = arguments.refresh || !arguments.view.serve.empty();
  MapFile file =
      MapFile::open(arguments.map, changes ? MapFile::Access::ReadWrite : MapFile::Access::Read);
  if (!arguments.robot.record.file.empty()) {
    keepMapBefore(file, arguments.robot.record.file);
  }
  return file;
}

} // namespace

NavigateArguments navigateArguments(const nlohmann::json &mission)
{
  NavigateArguments arguments;
  mission.at("to").get_to(arguments.to);
  mission.at("repeat").get_to(arguments.repeat);
  mission.at("homing").get_to(arguments.homing);
  mission.at("max_time").get_to(arguments.maxTime);
  mission.at("refresh").get_to(arguments.refresh);
  return arguments;
}

int navigate(const NavigateArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  MapFile file = openMap(arguments);
  const std::vector<GoalWord> words = parseGoals(arguments.to, file);
  if (arguments.from >= 0) {
    requireNode(file, arguments.from);
  }
  const std::optional<TruthLog> log = loadTruthLog(truthLogFile(arguments.map));
  const std::unique_ptr<MissionRobot> robot =
      makeMissionRobot(arguments.robot, startPose(arguments, log), mission(arguments));
  const PilotOptions options =
      pilotOptions(robot->files().rig, robot->runsByItself(), arguments.homing);
  file.expectMadeWith(mapHeader(robot->files(), options));
  const auto dashboard = openDashboard(arguments.view, arguments.robot, *robot);
  const auto viewer = openViewer(arguments.view, *robot, options.directions, dashboard.get());
  const Devices devices = viewer ? viewer->devices() : robot->devices();
  const Time start = robot->watch();
  const auto seconds = [&] { return toSeconds(robot->watch() - start); };
  Pilot pilot(devices, robot->files().robot, robot->files().camera, options,
              dashboard ? dashboard->halt() : stopSignal());
  if (arguments.verbose || viewer) {
    pilot.trace = [&](const std::string &line) {
      if (viewer) {
        viewer->say(line);
      }
      if (arguments.verbose) {
        std::printf("  # %.1f s %s\n", seconds(), line.c_str());
      }
    };
  }
  if (viewer) {
    viewer->watch(pilot);
  }
  Navigation navigation(file, pilot, devices.clock, arguments.refresh ? &file : nullptr);
  navigation.onStep = [&](const Step<NavigatorState> &step) {
    endProgress();
    for (const std::string &line : step.log) {
      std::printf("%s\n", line.c_str());
    }
    std::fflush(stdout);
    robot->note({{"event", "step"}, {"lines", step.log}});
    if (viewer) {
      viewer->step(navigation.map(), log ? log->nodes : std::map<NodeId, Pose2>{}, step.state.route,
                   commandWords(step.command));
    }
    if (dashboard) {
      dashboard->follow(file, step.log);
    }
    showProgress("robot time " + std::to_string(std::lround(seconds())) + " s");
  };
  const std::vector<NavigationGoal> goals =
      findGoals(words, navigation, robot->files().camera, file.header().panorama);
  sayWhatPicturesShow(goals);
  Visits visits = visitInTurn(arguments, goals, navigation, *robot, log);
  if (dashboard) {
    serve(*dashboard, file, !arguments.robot.replay.empty(), visits,
          [&](std::optional<NodeId> goal) {
            if (!goal) {
              return visitInTurn(arguments, goals, navigation, *robot, log);
            }
            NavigateArguments once = arguments;
            once.repeat = 1;
            Navigation fresh(file, pilot, devices.clock, arguments.refresh ? &file : nullptr);
            fresh.onStep = navigation.onStep; // through the map as it is by now
            return visitInTurn(once, {{std::to_string(goal->value), *goal, std::nullopt}}, fresh,
                               *robot, log);
          });
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  const bool patrol = goals.size() > 1 || arguments.repeat != 1;
  return report(arguments, visits, patrol, file.map(), *robot, seconds(), wall.count());
}

void addNavigateCommand(CliCommand app)
{
  auto arguments = std::make_shared<NavigateArguments>();
  CliCommand command = app.command("navigate", "Drive to places of a map by sight");
  command.examples("Example: homeward navigate --map lab.hwm --world data/worlds/lab.sdf --to 3\n"
                   "Patrol: homeward navigate --map lab.hwm --to 3,kitchen,photo.jpg --repeat 5\n"
                   "A picture is one of the robot's mirror, or a panorama as unwrap writes it.\n"
                   "Without --start or --from the simulated robot stands where it was left.");
  addRobotArguments(command, arguments->robot);
  addRecordOptions(command, arguments->robot.record);
  command.option("--map", arguments->map, "Map file").required();
  command.option("--to", arguments->to, "Goals in turn: numbers or names of nodes, or pictures")
      .required();
  command.option("--repeat", arguments->repeat, "Times to drive to them in turn; 0: until stopped")
      .between(0, 1000000000)
      .showDefault();
  command.option("--from", arguments->from, "Start at this node's true place, any heading");
  command
      .option("--homing", arguments->homing, "How the robot finds home by sight; hiss as the seed")
      .oneOf(homingMethodNames())
      .showDefault();
  command
      .option("--max-time", arguments->maxTime,
              "Seconds of robot time after which a goal is given up")
      .positive()
      .showDefault();
  command.flag("--refresh", arguments->refresh,
               "Keep how ways went, and new pictures of goals that look otherwise now, in the map");
  command.flag("--verbose", arguments->verbose, "Print every decision");
  addViewOptions(command, arguments->view);
  command.json(arguments->json, "a summary");
  command.run([arguments] { return navigate(*arguments); });
}

} // namespace homeward
