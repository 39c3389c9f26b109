// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/mission_trial.h>

#include "parallel.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <chrono>
#include <mutex>

namespace homeward
{
namespace
{

constexpr std::uint32_t kSecondRobotStream = 405;

class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_begin).count();
  }

private:
  std::chrono::steady_clock::time_point m_begin = std::chrono::steady_clock::now();
};

SimulatorOptions simulation(const MissionTrialOptions &options, std::uint64_t seed,
                            LightPreset light)
{
  SimulatorOptions simulator;
  simulator.seed = seed;
  simulator.light = light;
  simulator.threads = options.threads;
  return simulator;
}

/** What goes on in a simulated world, as the options say; nothing where it is quiet. */
std::unique_ptr<RestlessWorld> restlessWorld(const MissionTrialOptions &options,
                                             Simulator &simulator, const MissionTask &task,
                                             std::uint64_t seed)
{
  return options.restlessness
             ? std::make_unique<RestlessWorld>(simulator, task.scene, *options.restlessness, seed)
             : nullptr;
}

/** One exploration, with what only the simulator knows of it. */
class Exploration
{
public:
  Exploration(const MissionTask &task, const MissionTrialOptions &options,
              const std::atomic<bool> &stop)
      : m_options(options), m_stop(stop),
        m_simulator(task.scene, options.robot, options.camera,
                    simulation(options, task.seed, options.light)),
        m_restless(restlessWorld(options, m_simulator, task, task.seed)),
        m_file(MapFile::create(task.map, options.header, MapFile::IfExists::Replace))
  {
    m_log.world = task.worldFile;
    m_log.robot = options.robotFile;
    m_log.light = std::string(name(options.light));
    m_log.seed = task.seed;
    m_log.forwardDistance = options.explorer.forwardDistance;
    m_log.start = m_simulator.truth().pose;
  }

  /** Explores and fills in what is known of it then. */
  void run(MissionTrial &trial)
  {
    Pilot pilot(
        {m_simulator.clock(), m_simulator.base(), m_simulator.laser(), m_simulator.camera()},
        m_options.robot, m_options.camera, m_options.exploring, m_stop);
    pilot.onView = [this] { m_viewTruth = m_simulator.truth().pose; };
    const Explorer explorer(m_options.explorer);
    const auto enough = [this] { return seconds() > m_options.maxTime; };
    const auto onStep = [this](const Step<ExplorerState> &step) { follow(step); };
    const Finish finish = runMission(explorer, explorer.start(m_file.map()), pilot, m_file.map(),
                                     &m_file, m_simulator.clock(), trial.homings, enough, onStep);
    m_log.end = m_simulator.truth().pose;
    trial.outcome = finish.outcome;
    trial.reason = finish.reason;
    measure(trial);
    if (!m_log.nodes.empty()) {
      saveTruthLog(truthLogFile(m_file.path()), m_log);
    }
    m_file.close();
  }

  /** Compares the map with the world. */
  void judge(MissionTrial &trial)
  {
    const FreeSpace &space = m_simulator.freeSpace();
    const Eigen::Vector2d start = m_log.start.translation();
    const double reach = coverageReach(m_options.explorer.forwardDistance);
    trial.truth =
        judgeMission(space, start, m_log.nodes, m_file.map(), m_options.explorer.forwardDistance);
    trial.coverage = coverageOverTime(space, start, m_made, reach);
    trial.oracle = oracleTour(space, start, reach);
    trial.oracleSeconds = trial.oracle.length / m_options.exploring.motion.maxSpeed;
  }

  const TruthLog &log() const { return m_log; }

private:
  double seconds() { return toSeconds(m_simulator.clock().now()); }

  void follow(const Step<ExplorerState> &step)
  {
    m_log.path.push_back(m_simulator.truth().pose.translation());
    for (const MapChange &change : step.changes) {
      if (const auto *added = std::get_if<NodeAdded>(&change)) {
        m_log.nodes[added->node.id] = m_viewTruth;
        m_made.emplace_back(seconds(), m_viewTruth.translation());
      }
    }
  }

  void measure(MissionTrial &trial)
  {
    const Truth truth = m_simulator.truth();
    const TopologicalMap &map = m_file.map();
    trial.nodes = map.nodes().size();
    trial.edges = map.edges().size();
    trial.openDirections = map.openDirectionCount();
    trial.collisions = truth.collisions;
    trial.unseenContacts = truth.unseenContacts;
    trial.distance = truth.distance;
    trial.seconds = seconds();
  }

  const MissionTrialOptions &m_options;
  const std::atomic<bool> &m_stop;
  Simulator m_simulator;
  std::unique_ptr<RestlessWorld> m_restless; ///< null where it is quiet
  MapFile m_file;
  TruthLog m_log;
  Pose2 m_viewTruth; ///< where the last survey's picture was taken
  std::vector<std::pair<double, Eigen::Vector2d>> m_made; ///< seconds and place of each node
};

void driveThrough(const MissionTask &task, const MissionTrialOptions &options, const TruthLog &log,
                  const std::atomic<bool> &stop, MissionTrial &trial)
{
  const std::uint64_t seed = Random(task.seed, kSecondRobotStream).bits();
  SimulatorOptions how = simulation(options, seed, options.lightNow);
  how.start = log.start;
  Simulator simulator(task.scene, options.robot, options.camera, how);
  const auto restless = restlessWorld(options, simulator, task, seed);
  const MapFile file = MapFile::open(task.map, MapFile::Access::Read);
  const GoalDriver driver{simulator,          options.robot,     options.camera,
                          options.navigating, options.navigator, restless.get()};
  trial.goals = driveToGoals(driver, file, log, options.goals, task.seed, stop);
  trial.kidnappings =
      driveAfterKidnappings(driver, file, log, options.kidnappings, task.seed, stop);
  trial.barred = driveAtBarriers(driver, file, log, options.barriers, task.seed, stop);
}

TruthLog exploredBefore(const MissionTask &task)
{
  const std::filesystem::path file = truthLogFile(task.map);
  std::optional<TruthLog> log = loadTruthLog(file);
  if (!log) {
    throw ConfigError("there is no " + file.string() + ", which says where the nodes of " +
                      task.map.string() + " truly are; explore again");
  }
  return *log;
}

} // namespace

std::optional<MissionTrial> runMissionTrial(const MissionTask &task,
                                            const MissionTrialOptions &options,
                                            const std::atomic<bool> &stop)
{
  const Stopwatch watch;
  MissionTrial trial;
  TruthLog log;
  if (task.explored) {
    trial = *task.explored;
    log = exploredBefore(task);
  }
  else {
    trial.world = task.world;
    trial.seed = task.seed;
    Exploration exploration(task, options, stop);
    exploration.run(trial);
    trial.wallSeconds = watch.seconds();
    if (stop) {
      return std::nullopt;
    }
    exploration.judge(trial);
    log = exploration.log();
  }
  if (!log.nodes.empty()) {
    driveThrough(task, options, log, stop, trial);
  }
  trial.allWallSeconds = watch.seconds();
  return stop ? std::nullopt : std::optional(trial);
}

void runMissionTrials(
    const std::vector<MissionTask> &tasks, const MissionTrialOptions &options, int jobs,
    const std::atomic<bool> &stop,
    const std::function<void(const MissionTask &task, const MissionTrial &trial)> &done)
{
  std::mutex mutex;
  inParallel(tasks.size(), jobs, [&](std::size_t index) {
    const MissionTask &task = tasks[index];
    const std::optional<MissionTrial> trial =
        stop ? std::nullopt : runMissionTrial(task, options, stop);
    if (trial) {
      const std::lock_guard lock(mutex);
      done(task, *trial);
    }
  });
}

} // namespace homeward
