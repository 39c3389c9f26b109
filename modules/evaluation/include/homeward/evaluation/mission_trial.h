// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/barred_drive.h>
#include <homeward/evaluation/coverage.h>
#include <homeward/evaluation/goal_drive.h>
#include <homeward/evaluation/mission_truth.h>
#include <homeward/evaluation/oracle_tour.h>
#include <homeward/evaluation/restless_world.h>
#include <homeward/mission/explorer.h>
#include <homeward/mission/navigator.h>
#include <homeward/run/run_mission.h>

#include <filesystem>
#include <functional>
#include <memory>

namespace homeward
{

/** What is tried, alike in every trial. */
struct MissionTrialOptions
{
  RobotDescription robot;                  ///< its shape
  std::string robotFile;                   ///< its URDF file, for the truth log
  MirrorCamera camera;                     ///< nominal
  PilotOptions exploring = {};             ///< settings of the pilot that explores
  PilotOptions navigating = {};            ///< and of the one that drives to goals
  MapHeader header = {};                   ///< of the map
  ExplorerOptions explorer = {};           ///< of its decisions
  NavigatorOptions navigator = {};         ///< of the drives that follow
  double maxTime = 1e5;                    ///< simulated s after which the exploration stops
  LightPreset light = LightPreset::Day;    ///< while it explores
  LightPreset lightNow = LightPreset::Day; ///< while it drives to goals
  std::size_t goals = 20;                  ///< random nodes to drive to
  std::size_t kidnappings = 0;             ///< drives after being carried off
  std::size_t barriers = 0;                ///< edges that are barred, one at a time, and driven at
  std::optional<Restlessness> restlessness = {}; ///< of the worlds all the while; nothing: quiet
  int threads = 1;                               ///< that render; the result does not depend on it
};

struct MissionTrial;

/** One of the worlds and seeds that are tried. */
struct MissionTask
{
  std::string world;                  ///< its name
  std::string worldFile;              ///< SDF file
  std::shared_ptr<const Scene> scene; ///< of that file
  std::uint64_t seed = 1;             ///< of optics, noise, slip, goals
  std::filesystem::path map;          ///< to write, with its truth log; an older one is replaced
  /** What exploring `map` came to, when that was done before: it is left as it is. */
  std::shared_ptr<const MissionTrial> explored = nullptr;
};

/** A whole exploration of one world and drives through the map, against the truth. */
struct MissionTrial
{
  std::string world;      ///< name of its file
  std::uint64_t seed = 0; ///< decides everything in it

  Outcome outcome = Outcome::Failed;    ///< of the exploration
  std::string reason;                   ///< of that outcome, in words
  std::size_t nodes = 0;                ///< of the map
  std::size_t edges = 0;                ///< of the map
  int openDirections = 0;               ///< left
  MissionCounts homings;                ///< while exploring
  int collisions = 0;                   ///< while exploring
  int unseenContacts = 0;               ///< while exploring
  double distance = 0.0;                ///< driven exploring, metres
  double seconds = 0.0;                 ///< simulated, exploring
  double wallSeconds = 0.0;             ///< that the exploration took
  MissionTruth truth;                   ///< about the map
  std::vector<CoverageSample> coverage; ///< when each node was made

  OracleTour oracle;          ///< to compare with
  double oracleSeconds = 0.0; ///< its length at the robot's highest speed

  std::vector<GoalDrive> goals;       ///< drives to random nodes
  std::vector<GoalDrive> kidnappings; ///< drives after being carried off
  std::vector<BarredDrive> barred;    ///< drives at barriers
  double allWallSeconds = 0.0;        ///< that everything took
};

/**
 * Explores a world in process, then drives through the map by another robot of the same kind: its
 * optics, slip and noise are drawn from another seed. Task and options alone decide the result,
 * but for the wall-clock times.
 * @param stop set by anybody at any time: ends the trial
 * @return nothing when it was stopped
 * @throw ConfigError when the robot fits nowhere or the map explored before has no truth log,
 * StoreError when the map cannot be written
 */
std::optional<MissionTrial> runMissionTrial(const MissionTask &task,
                                            const MissionTrialOptions &options,
                                            const std::atomic<bool> &stop);

/**
 * Runs trials side by side, begun in order.
 * @param jobs how many at a time
 * @param done called with each trial that has come to its end, never two at a time
 * @throw what a trial throws, after all others have come to their end
 */
void runMissionTrials(
    const std::vector<MissionTask> &tasks, const MissionTrialOptions &options, int jobs,
    const std::atomic<bool> &stop,
    const std::function<void(const MissionTask &task, const MissionTrial &trial)> &done);

} // namespace homeward
