// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_robot.h"
#include "mission_setup.h"
#include "mission_study.h"
#include "mission_table.h"
#include "recoveries.h"
#include "stop_signal.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/mission_summary.h>
#include <homeward/store/content_hash.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <map>
#include <memory>

namespace homeward
{
namespace
{

struct MissionArguments
{
  std::vector<std::string> worlds; ///< empty: the laboratory
  std::string rig;
  std::string out;
  std::int64_t firstSeed = 1;
  int seeds = 5;
  int jobs = 1;
  ExploreSettings settings;
  std::string light = "day";
  std::string lightNow; ///< empty: as light
  std::string maps;     ///< folder of an earlier study, whose maps are driven through; may be empty
  std::vector<std::string> without; ///< recoveries that are switched off
  std::size_t goals = 20;
  std::size_t kidnappings = 0;
  std::size_t barriers = 0;
  std::size_t restless = 0; ///< people who walk about while chairs get moved; 0: all is quiet
  std::string json;

  const std::string &goalLight() const { return lightNow.empty() ? light : lightNow; }
};

RobotFiles loadSimulatedRig(const std::string &rig)
{
  RobotFiles files = loadRobotFiles(rig);
  if (files.rig.devices) {
    throw ConfigError("the rig " + files.rigFile.string() +
                      " is a real one; missions are evaluated in simulation");
  }
  return files;
}

MissionTrialOptions trialOptions(const MissionArguments &arguments, const RobotFiles &files)
{
  MissionTrialOptions options{
      .robot = files.robot, .robotFile = files.robotFile, .camera = files.camera};
  options.exploring = explorationOptions(files.rig, false, arguments.settings);
  options.navigating = pilotOptions(files.rig, false, arguments.settings.homing);
  options.header = mapHeader(files, options.exploring);
  options.explorer = explorerOptions(arguments.settings);
  options.navigator.cost = options.explorer.cost;
  options.maxTime = arguments.settings.maxTime;
  options.light = parseLightPreset(arguments.light);
  options.lightNow = parseLightPreset(arguments.goalLight());
  options.goals = arguments.goals;
  options.kidnappings = arguments.kidnappings;
  options.barriers = arguments.barriers;
  if (arguments.restless > 0) {
    options.restlessness = Restlessness{.people = arguments.restless};
  }
  switchOff(arguments.without, options);
  return options;
}

/** What results of one folder must have in common. */
nlohmann::json studyOptions(const MissionArguments &arguments, const RobotFiles &files)
{
  const std::string rig =
      readText(files.rigFile, "rig") + readText(files.robotFile, "robot") + files.cameraText;
  nlohmann::json options = {{"version", jsonHeader("")["version"]},
                            {"rig", contentHashText(rig)},
                            {"forward_distance_m", arguments.settings.forwardDistance},
                            {"homing", arguments.settings.homing},
                            {"histogram_threshold", arguments.settings.histogramThreshold},
                            {"equal_costs", arguments.settings.equalCosts},
                            {"close_known", arguments.settings.closeKnown},
                            {"max_time_s", arguments.settings.maxTime},
                            {"without", arguments.without},
                            {"maps", arguments.maps},
                            {"light", arguments.light},
                            {"light_now", arguments.goalLight()},
                            {"goals", arguments.goals},
                            {"kidnappings", arguments.kidnappings},
                            {"restless", arguments.restless}};
  if (arguments.barriers > 0) { // results without are older, too
    options["barriers"] = arguments.barriers;
  }
  return options;
}

void say(const MissionTrial &trial)
{
  const GoalSummary goals = summariseDrives(trial.goals);
  std::printf("%s-%llu: %s, coverage %.1f %%, %zu nodes, %.0f m, %zu of %zu goals, %.0f s\n",
              trial.world.c_str(), static_cast<unsigned long long>(trial.seed), name(trial.outcome),
              100.0 * trial.truth.coverage, trial.nodes, trial.distance, goals.arrived.successes,
              goals.arrived.trials, trial.allWallSeconds);
  std::fflush(stdout);
}

/** A world's trials, as far as they have come to their end, in the order of their seeds. */
std::vector<MissionTrial> finished(const MissionArguments &arguments, const MissionStudy &study,
                                   const StudiedWorld &world)
{
  std::vector<MissionTrial> trials;
  for (int i = 0; i < arguments.seeds; ++i) {
    if (auto trial = study.find(world, static_cast<std::uint64_t>(arguments.firstSeed + i))) {
      trials.push_back(std::move(*trial));
    }
  }
  return trials;
}

void runMissing(const MissionArguments &arguments, const MissionTrialOptions &options,
                const MissionStudy &study, const std::vector<StudiedWorld> &worlds)
{
  std::vector<MissionTask> tasks;
  std::map<std::string, StudiedWorld> worldOf;
  for (const StudiedWorld &world : worlds) {
    worldOf[world.name] = world;
    for (int i = 0; i < arguments.seeds; ++i) {
      const auto seed = static_cast<std::uint64_t>(arguments.firstSeed + i);
      if (study.find(world, seed)) {
        std::printf("%s-%llu: is there\n", world.name.c_str(),
                    static_cast<unsigned long long>(seed));
      }
      else {
        tasks.push_back(study.task(world, seed, arguments.maps));
      }
    }
  }
  if (tasks.empty()) {
    return;
  }
  std::size_t done = 0;
  const auto progress = [&] {
    showProgress("trial " + std::to_string(done + 1) + " of " + std::to_string(tasks.size()));
  };
  progress();
  runMissionTrials(tasks, options, arguments.jobs, stopSignal(),
                   [&](const MissionTask &task, const MissionTrial &trial) {
                     study.keep(worldOf.at(task.world), trial);
                     endProgress();
                     say(trial);
                     ++done;
                     progress();
                   });
  endProgress();
}

nlohmann::json summarise(const MissionArguments &arguments, const MissionStudy &study,
                         const std::vector<StudiedWorld> &worlds)
{
  WorldSummaries summaries;
  for (const StudiedWorld &world : worlds) {
    const std::vector<MissionTrial> trials = finished(arguments, study, world);
    summaries.emplace_back(world.name, summariseTrials(trials));
    writeText(study.file(world.name + "-coverage.svg"), coverageChart(world.name, trials));
  }
  std::fputs(missionTable(summaries).c_str(), stdout);
  return missionSummaryJson(summaries);
}

int evaluateMission(const MissionArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  const RobotFiles files = loadSimulatedRig(arguments.rig);
  const MissionTrialOptions options = trialOptions(arguments, files);
  const std::vector<StudiedWorld> worlds = loadWorlds(
      arguments.worlds.empty() ? std::vector<std::string>{shippedFile("worlds/lab.sdf").string()}
                               : arguments.worlds);
  const MissionStudy study(arguments.out, studyOptions(arguments, files));
  runMissing(arguments, options, study, worlds);
  if (stopSignal()) {
    std::printf("stopped; what has come to its end is in %s, the same command goes on\n",
                arguments.out.c_str());
    return kExitFailed;
  }
  nlohmann::json json = jsonHeader("evaluate mission");
  json["seed"] = arguments.firstSeed;
  json["seeds"] = arguments.seeds;
  json["options"] = studyOptions(arguments, files);
  json["worlds"] = summarise(arguments, study, worlds);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(study.file("summary.json"), json);
  writeJson(arguments.json, json);
  return kExitDone;
}

} // namespace

void addEvaluateMissionCommand(CliCommand evaluate)
{
  auto arguments = std::make_shared<MissionArguments>();
  CliCommand command =
      evaluate.command("mission", "Whole explorations, and drives through their maps");
  command.examples(
      "Example: homeward evaluate mission --worlds data/worlds/lab.sdf house.world --seeds 5 "
      "--jobs 2 --out missions\n"
      "Each result is kept at once; the same command goes on after an interruption.");
  command.option("--worlds", arguments->worlds, "SDF worlds to explore (default: the laboratory)");
  command.option("--seeds", arguments->seeds, "Explorations of each, each with its own seed")
      .between(1, 10000)
      .showDefault();
  command.option("--seed", arguments->firstSeed, "The first of them").showDefault();
  command.option("--out", arguments->out, "Folder of the results; made if need be").required();
  command.option("--jobs", arguments->jobs, "Explorations at a time").between(1, 64).showDefault();
  command.option("--goals", arguments->goals, "Drives to random nodes through each map")
      .between(0, 10000)
      .showDefault();
  command
      .option("--kidnappings", arguments->kidnappings,
              "Drives from anywhere through each map, by a robot that was carried off")
      .between(0, 10000)
      .showDefault();
  command
      .option("--barriers", arguments->barriers,
              "Edges of each map to bar, one at a time: drives from one end to the other")
      .between(0, 10000)
      .showDefault();
  addRestless(command, arguments->restless);
  command.option("--rig", arguments->rig, "Rig file: robot, camera, limits (YAML)");
  command.option("--light", arguments->light, "day, twilight, night or two_lamps").showDefault();
  command.option("--light-now", arguments->lightNow, "Light of the drives (default: as --light)");
  command.option("--maps", arguments->maps,
                 "Folder of an earlier evaluation: drive through its maps, explore nothing");
  command.option("--without", arguments->without, "Recoveries to switch off, to count what they do")
      .oneOf(recoveryNames());
  addExploreSettings(command, arguments->settings);
  command.json(arguments->json, "the summary");
  command.run([arguments] { return evaluateMission(*arguments); });
}

} // namespace homeward
