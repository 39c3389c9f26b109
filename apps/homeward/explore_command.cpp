// SPDX-License-Identifier: GPL-3.0-or-later
#include "explore.h"

#include "command.h"
#include "files.h"
#include "operated.h"
#include "recording.h"
#include "stop_signal.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/mission_truth.h>
#include <homeward/evaluation/truth_log.h>
#include <homeward/mission/explorer.h>
#include <homeward/record/replayed_devices.h>
#include <homeward/run/navigation.h>
#include <homeward/run/run_mission.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

/** One exploration, from its files to its summary. */
class Exploration
{
public:
  explicit Exploration(const ExploreArguments &arguments)
      : m_arguments(arguments), m_before(loadBefore()),
        m_robot(makeMissionRobot(arguments.robot,
                                 m_before ? std::optional(m_before->end) : std::nullopt,
                                 mission(arguments))),
        m_pilotOptions(
            explorationOptions(m_robot->files().rig, m_robot->runsByItself(), arguments.settings)),
        m_dashboard(openDashboard(arguments.view, arguments.robot, *m_robot)),
        m_viewer(
            openViewer(arguments.view, *m_robot, m_pilotOptions.directions, m_dashboard.get())),
        m_devices(m_viewer ? m_viewer->devices() : m_robot->devices()), m_begin(m_robot->watch()),
        m_file(openFile()),
        m_pilot(m_devices, m_robot->files().robot, m_robot->files().camera, m_pilotOptions,
                m_dashboard ? m_dashboard->halt() : stopSignal())
  {
    if (const std::optional<SimulatedWorld> world = m_robot->world()) {
      beginTruth(*world);
    }
    if (arguments.verbose || m_viewer) {
      m_pilot.trace = [this](const std::string &line) { say(line); };
    }
    if (m_viewer) {
      m_viewer->watch(m_pilot);
    }
    m_pilot.onView = [this] { followView(); };
    rememberAll(m_file, m_pilot);
    m_operator = makeOperator(*m_robot, arguments.robot);
  }

  Finish run()
  {
    Finish finish = exploreOn();
    endProgress();
    if (m_dashboard) {
      serve(finish);
    }
    m_file.close();
    return finish;
  }

  /** @return false when a replay differs from what was recorded */
  bool summarise(const Finish &finish, double wallSeconds)
  {
    const TopologicalMap &map = m_file.map();
    const double robotSeconds = seconds();
    const std::optional<Truth> truth = m_robot->truth();
    const double distance = truth ? truth->distance : m_pilot.travelled();
    std::printf("%s: %s\n", name(finish.outcome), finish.reason.c_str());
    std::printf("nodes %zu, edges %zu, open directions %d, homings %d of %d arrived\n",
                map.nodes().size(), map.edges().size(), map.openDirectionCount(),
                m_counts.homingsArrived, m_counts.homingsTried);
    std::printf("distance %.1f m, %s %.0f s, wall-clock %.1f s (%.1f times real time)\n", distance,
                timeName(), robotSeconds, wallSeconds, robotSeconds / wallSeconds);
    nlohmann::json json = jsonHeader("explore");
    json["seed"] = m_truth.seed;
    json["wall_time_s"] = wallSeconds;
    json["outcome"] = name(finish.outcome);
    json["reason"] = finish.reason;
    json["nodes"] = map.nodes().size();
    json["edges"] = map.edges().size();
    json["open_directions"] = map.openDirectionCount();
    json["homings"] = {{"tried", m_counts.homingsTried}, {"arrived", m_counts.homingsArrived}};
    json["distance_m"] = distance;
    json["sim_time_s"] = robotSeconds;
    if (truth) {
      judge(*truth, json);
    }
    const bool same = m_robot->finish(json);
    writeJson(m_arguments.json, json);
    return same;
  }

  void sayHowToGoOn() const
  {
    std::string command = "homeward explore --resume --map " + m_arguments.map;
    if (!m_arguments.robot.simulation.world.empty()) {
      command += " --world " + m_arguments.robot.simulation.world;
    }
    if (!m_arguments.robot.simulation.rig.empty()) {
      command += " --rig " + m_arguments.robot.simulation.rig;
    }
    std::printf("the robot stands and the map is kept; go on with: %s\n", command.c_str());
  }

private:
  /** What a replay must know. */
  static nlohmann::json mission(const ExploreArguments &arguments)
  {
    return {{"command", "explore"},
            {"settings", settingsJson(arguments.settings)},
            {"resume", arguments.resume}};
  }

  /** Does what is wanted at the page until Ctrl-C. @param finish of the exploration */
  void serve(Finish &finish)
  {
    std::string words = std::string(name(finish.outcome)) + ": " + finish.reason;
    while (true) {
      std::printf("%s; Ctrl-C ends the page\n", words.c_str());
      std::fflush(stdout);
      const bool resumable = finish.outcome == Outcome::Stopped && m_arguments.robot.replay.empty();
      const NextDrive next = m_dashboard->await(m_file, words, resumable);
      if (next.kind == NextDrive::Kind::End) {
        return;
      }
      if (next.kind == NextDrive::Kind::Resume) {
        finish = exploreOn();
        words = std::string(name(finish.outcome)) + ": " + finish.reason;
      }
      else {
        words = driveTo(next.goal);
      }
      endProgress();
    }
  }

  /** Through the map as it is by now. @return how it went */
  std::string driveTo(NodeId goal)
  {
    Navigation navigation(m_file, m_pilot, m_devices.clock);
    navigation.onStep = [&](const Step<NavigatorState> &step) {
      show(step.log, step.state.route, step.command);
    };
    const double patience = m_arguments.settings.maxTime;
    const GoalReport report = runOperated(*m_robot, m_operator.get(), m_arguments.robot,
                                          [&] { return navigation.driveTo(goal, patience); });
    return std::string(name(report.outcome)) + ": " + report.reason;
  }

  Finish exploreOn()
  {
    try {
      return runOperated(*m_robot, m_operator.get(), m_arguments.robot, [this] { return goOn(); });
    }
    catch (const RecordingEnded &end) {
      return {Outcome::Stopped, end.what()};
    }
    catch (const DeviceError &fault) {
      if (m_arguments.robot.replay.empty()) {
        throw;
      }
      return {Outcome::Failed, fault.what()}; // as then
    }
  }

  /** Explores on from what the map file holds, of a drive that broke off too. */
  Finish goOn()
  {
    const Explorer explorer(explorerOptions(m_arguments.settings));
    const auto enough = [this] { return seconds() > m_arguments.settings.maxTime; };
    const auto onStep = [this](const Step<ExplorerState> &step) { follow(step); };
    const ExplorerState before = keptExploration(m_file).value_or(ExplorerState{});
    return runMission(explorer, explorer.resume(before, m_file.map()), m_pilot, m_file.map(),
                      &m_file, m_devices.clock, m_counts, enough, onStep);
  }

  std::optional<TruthLog> loadBefore() const
  {
    return m_arguments.resume ? loadTruthLog(truthLogFile(m_arguments.map)) : std::nullopt;
  }

  MapFile openFile() const
  {
    const MapHeader header = mapHeader(m_robot->files(), m_pilotOptions);
    const auto ifExists =
        m_arguments.overwrite ? MapFile::IfExists::Replace : MapFile::IfExists::Refuse;
    if (!m_arguments.resume) {
      return MapFile::create(m_arguments.map, header, ifExists);
    }
    if (!m_arguments.robot.replay.empty()) {
      const MapFile before =
          MapFile::open(mapBefore(m_arguments.robot.replay), MapFile::Access::Read);
      return MapFile::copyOf(before, m_arguments.map, ifExists);
    }
    MapFile file = MapFile::open(m_arguments.map);
    file.expectMadeWith(header);
    if (!m_arguments.robot.record.file.empty()) {
      keepMapBefore(file, m_arguments.robot.record.file);
    }
    return file;
  }

  /** Of robot time since the beginning. */
  double seconds() const { return toSeconds(m_robot->watch() - m_begin); }

  const char *timeName() const { return m_robot->runsByItself() ? "robot time" : "simulated"; }

  void beginTruth(const SimulatedWorld &world)
  {
    const Pose2 pose = m_robot->truth().value().pose;
    m_truth = m_before.value_or(TruthLog{});
    m_truth.world = world.world;
    m_truth.robot = m_robot->files().robotFile;
    m_truth.light = world.light;
    m_truth.seed = world.seed;
    m_truth.forwardDistance = m_arguments.settings.forwardDistance;
    if (!m_before) {
      m_truth.start = pose;
    }
    if (!m_before && m_file.map().nodes().size() <= 1) {
      m_truth.nodes[NodeId{0}] = pose; // the first is made where the robot stands
    }
    m_truth.end = pose;
  }

  void judge(const Truth &truth, nlohmann::json &json)
  {
    const MissionTruth judged =
        judgeMission(*m_robot->freeSpace(), m_truth.start.translation(), m_truth.nodes,
                     m_file.map(), m_arguments.settings.forwardDistance);
    std::printf("collisions %d, contacts the laser cannot see %d\n", truth.collisions,
                truth.unseenContacts);
    std::printf("truth: coverage %.1f %%, false edges %d, duplicate nodes %d\n",
                100.0 * judged.coverage, judged.falseEdges, judged.duplicateNodes);
    json["collisions"] = truth.collisions;
    json["unseen_contacts"] = truth.unseenContacts;
    json["truth"] = {{"coverage", judged.coverage},
                     {"false_edges", judged.falseEdges},
                     {"duplicate_nodes", judged.duplicateNodes}};
  }

  /** A line for whoever looks for the reason of something, with when and where it was. */
  void say(const std::string &line) const
  {
    if (m_viewer) {
      m_viewer->say(line);
    }
    if (!m_arguments.verbose) {
      return;
    }
    std::string where;
    if (const std::optional<Truth> truth = m_robot->truth()) {
      char text[120];
      std::snprintf(text, sizeof text, ", at %.2f,%.2f,%.2f, %d collisions, %d unseen",
                    truth->pose.x, truth->pose.y, truth->pose.heading, truth->collisions,
                    truth->unseenContacts);
      where = text;
    }
    std::printf("  # %.1f s%s: %s\n", seconds(), where.c_str(), line.c_str());
  }

  /** To all who look on. */
  void show(const std::vector<std::string> &log, const std::vector<NodeId> &way,
            const Command &command)
  {
    endProgress();
    for (const std::string &line : log) {
      std::printf("%s\n", line.c_str());
    }
    std::fflush(stdout);
    if (m_viewer) {
      m_viewer->step(m_file.map(), m_truth.nodes, way, commandWords(command));
    }
    if (m_dashboard) {
      m_dashboard->follow(m_file, log);
    }
  }

  void follow(const Step<ExplorerState> &step)
  {
    m_robot->note({{"event", "step"}, {"lines", step.log}});
    show(step.log, wayOf(step.state), step.command);
    if (const std::optional<Truth> truth = m_robot->truth()) {
      m_truth.path.push_back(truth->pose.translation());
      saveTruth(truth->pose);
    }
    showProgress(std::string(timeName()) + " " + std::to_string(std::lround(seconds())) +
                 " s, nodes " + std::to_string(m_file.map().nodes().size()) + ", open directions " +
                 std::to_string(m_file.map().openDirectionCount()));
  }

  /** The nodes that it goes by, from the one it left on. */
  static std::vector<NodeId> wayOf(const ExplorerState &state)
  {
    std::vector<NodeId> way = state.route;
    if (state.target && way.empty()) {
      way.push_back(*state.target);
    }
    if (state.origin && !way.empty()) {
      way.insert(way.begin(), *state.origin);
    }
    return way;
  }

  /** Known and on disk before the node that is made of the view: a crash leaves none without. */
  void followView()
  {
    if (const std::optional<Truth> truth = m_robot->truth()) {
      m_truth.nodes[m_file.map().nextNodeId()] = truth->pose;
      saveTruth(truth->pose);
    }
  }

  /** After every step, so that a simulated robot goes on near where a crash has left it; an older
   * map that is to be replaced keeps its own until the new one has a place. */
  void saveTruth(const Pose2 &pose)
  {
    if (!m_file.map().nodes().empty()) {
      m_truth.end = pose;
      saveTruthLog(truthLogFile(m_arguments.map), m_truth);
    }
  }

  const ExploreArguments &m_arguments;
  std::optional<TruthLog> m_before;
  std::unique_ptr<MissionRobot> m_robot;
  PilotOptions m_pilotOptions;
  std::unique_ptr<Dashboard> m_dashboard;  ///< null: no browser looks on
  std::unique_ptr<MissionViewer> m_viewer; ///< null: nobody looks on
  Devices m_devices;
  Time m_begin;
  MapFile m_file;
  Pilot m_pilot;
  TruthLog m_truth;
  MissionCounts m_counts;
  std::unique_ptr<OperatorInput> m_operator; ///< null in simulation
};

} // namespace

int explore(const ExploreArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  Exploration exploration(arguments);
  const Finish finish = exploration.run();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  const bool same = exploration.summarise(finish, wall.count());
  if (!arguments.robot.replay.empty()) {
    return same ? kExitDone : kExitFailed;
  }
  if (finish.outcome == Outcome::Stopped) {
    exploration.sayHowToGoOn();
  }
  return finish.outcome == Outcome::Done ? kExitDone : kExitFailed;
}

void addExploreCommand(CliCommand app)
{
  auto arguments = std::make_shared<ExploreArguments>();
  CliCommand command = app.command("explore", "Explore an unknown building and map it by sight");
  command.examples("Examples: homeward explore --world data/worlds/lab.sdf --map lab.hwm\n"
                   "          homeward explore --rig my_rig.yaml --map house.hwm");
  addRobotArguments(command, arguments->robot);
  addRecordOptions(command, arguments->robot.record);
  command.option("--map", arguments->map, "Map file to write").required();
  addExploreSettings(command, arguments->settings);
  command.flag("--overwrite", arguments->overwrite, "Replace an existing map");
  command.flag("--resume", arguments->resume, "Go on with an existing map");
  command.flag("--verbose", arguments->verbose,
               "Print every decision, and where the robot truly is");
  addViewOptions(command, arguments->view);
  command.json(arguments->json, "a summary");
  command.run([arguments] { return explore(*arguments); });
}

} // namespace homeward
