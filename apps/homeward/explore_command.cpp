// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_run.h"
#include "mission_setup.h"
#include "stop_signal.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/mission_truth.h>
#include <homeward/evaluation/truth_log.h>
#include <homeward/mission/explorer.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

struct ExploreArguments
{
  SimulationArguments simulation;
  std::string map;
  double forwardDistance = 2.0;
  std::string homing = "minwarping";
  double maxTime = 1e5;
  bool overwrite = false;
  bool resume = false;
  bool verbose = false;
  std::string json;
};

/** One exploration, from its files to its summary. */
class Exploration
{
public:
  explicit Exploration(const ExploreArguments &arguments)
      : m_arguments(arguments), m_before(loadBefore()),
        m_robot(arguments.simulation, m_before ? std::optional(m_before->end) : std::nullopt),
        m_pilotOptions(explorationOptions()), m_file(openFile()),
        m_pilot(m_robot.devices(), m_robot.robot(), m_robot.camera(), m_pilotOptions, stopSignal())
  {
    m_truth = m_before.value_or(TruthLog{});
    m_truth.world = arguments.simulation.world.empty() ? shippedFile("worlds/lab.sdf").string()
                                                       : arguments.simulation.world;
    m_truth.robot = m_robot.robotFile();
    m_truth.light = arguments.simulation.light;
    m_truth.seed = arguments.simulation.seed;
    m_truth.forwardDistance = arguments.forwardDistance;
    if (!m_before) {
      m_truth.start = m_robot.simulator().truth().pose;
    }
    m_truth.end = m_robot.simulator().truth().pose;
    if (arguments.verbose) {
      m_pilot.trace = [this](const std::string &line) { say(line); };
    }
    m_pilot.onView = [this] { m_viewTruth = m_robot.simulator().truth().pose; };
    rememberAll(m_file, m_pilot);
  }

  Finish run()
  {
    const Explorer explorer({.forwardDistance = m_arguments.forwardDistance});
    const auto enough = [this] {
      return toSeconds(m_robot.simulator().clock().now()) > m_arguments.maxTime;
    };
    const auto onStep = [this](const Step<ExplorerState> &step) { follow(step); };
    const Finish finish =
        runMission(explorer, explorer.start(m_file.map()), m_pilot, m_file.map(), &m_file,
                   m_robot.simulator().clock(), m_counts, enough, onStep);
    endProgress();
    if (!m_file.map().nodes().empty()) {
      saveTruth();
    }
    m_file.close();
    return finish;
  }

  void summarise(const Finish &finish, double wallSeconds) const
  {
    const Truth truth = m_robot.simulator().truth();
    const TopologicalMap &map = m_file.map();
    const double simSeconds = toSeconds(m_robot.simulator().clock().now());
    const MissionTruth judged =
        judgeMission(m_robot.simulator().freeSpace(), m_truth.start.translation(), m_truth.nodes,
                     map, m_arguments.forwardDistance);
    std::printf("%s: %s\n", name(finish.outcome).c_str(), finish.reason.c_str());
    std::printf("nodes %zu, edges %zu, open directions %d, homings %d of %d arrived\n",
                map.nodes().size(), map.edges().size(), map.openDirectionCount(),
                m_counts.homingsArrived, m_counts.homingsTried);
    std::printf("distance %.1f m, simulated %.0f s, wall-clock %.1f s (%.1f times real time)\n",
                truth.distance, simSeconds, wallSeconds, simSeconds / wallSeconds);
    std::printf("collisions %d, contacts the laser cannot see %d\n", truth.collisions,
                truth.unseenContacts);
    std::printf("truth: coverage %.1f %%, false edges %d, duplicate nodes %d\n",
                100.0 * judged.coverage, judged.falseEdges, judged.duplicateNodes);
    nlohmann::json json = jsonHeader("explore");
    json["seed"] = m_arguments.simulation.seed;
    json["wall_time_s"] = wallSeconds;
    json["outcome"] = name(finish.outcome);
    json["reason"] = finish.reason;
    json["nodes"] = map.nodes().size();
    json["edges"] = map.edges().size();
    json["open_directions"] = map.openDirectionCount();
    json["homings"] = {{"tried", m_counts.homingsTried}, {"arrived", m_counts.homingsArrived}};
    json["collisions"] = truth.collisions;
    json["unseen_contacts"] = truth.unseenContacts;
    json["distance_m"] = truth.distance;
    json["sim_time_s"] = simSeconds;
    json["truth"] = {{"coverage", judged.coverage},
                     {"false_edges", judged.falseEdges},
                     {"duplicate_nodes", judged.duplicateNodes}};
    writeJson(m_arguments.json, json);
  }

  void sayHowToGoOn() const
  {
    std::string command = "homeward explore --resume --map " + m_arguments.map;
    if (!m_arguments.simulation.world.empty()) {
      command += " --world " + m_arguments.simulation.world;
    }
    std::printf("the robot stands and the map is kept; go on with: %s\n", command.c_str());
  }

private:
  std::optional<TruthLog> loadBefore() const
  {
    return m_arguments.resume ? loadTruthLog(truthLogFile(m_arguments.map)) : std::nullopt;
  }

  PilotOptions explorationOptions() const
  {
    PilotOptions options = pilotOptions(m_robot, m_arguments.homing);
    options.directions = openDirectionOptions(m_arguments.forwardDistance);
    return options;
  }

  MapFile openFile() const
  {
    const MapHeader header = mapHeader(m_robot, m_pilotOptions);
    if (m_arguments.resume) {
      MapFile file = MapFile::open(m_arguments.map);
      file.expectMadeWith(header);
      return file;
    }
    return MapFile::create(m_arguments.map, header,
                           m_arguments.overwrite ? MapFile::IfExists::Replace
                                                 : MapFile::IfExists::Refuse);
  }

  /** A line for whoever looks for the reason of something, with when and where it was. */
  void say(const std::string &line) const
  {
    const Truth truth = m_robot.simulator().truth();
    std::printf("  # %.1f s, at %.2f,%.2f,%.2f, %d collisions, %d unseen: %s\n",
                toSeconds(m_robot.simulator().clock().now()), truth.pose.x, truth.pose.y,
                truth.pose.heading, truth.collisions, truth.unseenContacts, line.c_str());
  }

  void follow(const Step<ExplorerState> &step)
  {
    endProgress();
    for (const std::string &line : step.log) {
      std::printf("%s\n", line.c_str());
    }
    std::fflush(stdout);
    const Truth truth = m_robot.simulator().truth();
    m_truth.path.push_back(truth.pose.translation());
    for (const MapChange &change : step.changes) {
      if (const auto *added = std::get_if<NodeAdded>(&change)) {
        m_truth.nodes[added->node.id] = m_viewTruth;
        saveTruth();
      }
    }
    showProgress("simulated " +
                 std::to_string(std::lround(toSeconds(m_robot.simulator().clock().now()))) +
                 " s, nodes " + std::to_string(m_file.map().nodes().size()) + ", open directions " +
                 std::to_string(m_file.map().openDirectionCount()));
  }

  void saveTruth()
  {
    m_truth.end = m_robot.simulator().truth().pose;
    saveTruthLog(truthLogFile(m_arguments.map), m_truth);
  }

  const ExploreArguments &m_arguments;
  std::optional<TruthLog> m_before;
  mutable SimulatedRobot m_robot;
  PilotOptions m_pilotOptions;
  MapFile m_file;
  Pilot m_pilot;
  TruthLog m_truth;
  Pose2 m_viewTruth; ///< where the last survey's picture was taken
  MissionCounts m_counts;
};

int explore(const ExploreArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  Exploration exploration(arguments);
  const Finish finish = exploration.run();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  exploration.summarise(finish, wall.count());
  if (finish.outcome == Outcome::Stopped) {
    exploration.sayHowToGoOn();
  }
  return finish.outcome == Outcome::Done ? kExitDone : kExitFailed;
}

} // namespace

void addExploreCommand(CLI::App &app, int &status)
{
  auto arguments = std::make_shared<ExploreArguments>();
  CLI::App *command =
      app.add_subcommand("explore", "Explore an unknown building and map it by sight");
  command->footer("Example: homeward explore --world data/worlds/lab.sdf --map lab.hwm");
  addSimulationArguments(*command, arguments->simulation);
  command->add_option("--map", arguments->map, "Map file to write")->required();
  command
      ->add_option("--forward-distance", arguments->forwardDistance, "Metres driven before looking")
      ->check(CLI::Range(0.5, 20.0))
      ->capture_default_str();
  command->add_option("--homing", arguments->homing, "minwarping, or hiss as the seed")
      ->capture_default_str();
  command->add_option("--max-time", arguments->maxTime, "Simulated seconds after which it stops")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing map");
  command->add_flag("--resume", arguments->resume, "Go on with an existing map");
  command->add_flag("--verbose", arguments->verbose,
                    "Print every decision, and where the robot truly is");
  command->add_option("--json", arguments->json, "Write a summary as JSON (- for standard output)");
  command->callback([arguments, &status] { status = explore(*arguments); });
}

} // namespace homeward
