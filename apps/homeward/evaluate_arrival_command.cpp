// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_setup.h"
#include "view_source.h"

#include <homeward/evaluation/arrival_trials.h>
#include <homeward/homing/homing_method.h>
#include <homeward/viewer/home_vector_picture.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

struct ArrivalArguments
{
  SimulationArguments simulation;
  ArrivalOptions options;
  std::string lightMap = "day";
  std::string lightNow = "day";
  std::string homing = "minwarping";
  double mirrorAhead = 0.0;
  double mirrorYawDegrees = 0.0;
  std::string json;
  std::string picture;
};

nlohmann::json jsonOf(const Pose2 &pose)
{
  return {pose.x, pose.y, pose.heading};
}

nlohmann::json jsonOf(const ArrivalRun &run)
{
  return {{"home", jsonOf(run.home)},
          {"start", jsonOf(run.start)},
          {"end", jsonOf(run.end)},
          {"outcome", name(run.outcome)},
          {"arrived", run.arrived()},
          {"error_m", run.error()},
          {"heading_error_deg", degrees(run.headingError())},
          {"seconds", run.seconds},
          {"collisions", run.collisions}};
}

nlohmann::json jsonOf(const ArrivalScore &score)
{
  return {{"runs", score.runs},
          {"arrived", score.arrived},
          {"wrongly_arrived", score.wronglyArrived},
          {"median_error_m", score.medianError},
          {"median_heading_error_deg", score.medianHeadingDeg},
          {"median_seconds", score.medianSeconds},
          {"collisions", score.collisions}};
}

/** A panel for each drive that did not arrive. */
void drawFailures(const std::string &file, const std::vector<ArrivalRun> &runs,
                  const FloorPlan &plan)
{
  HomeVectorPicture picture;
  picture.floor = FloorPicture{plan.image, plan.origin, plan.resolution};
  for (const ArrivalRun &run : runs) {
    if (!run.arrived()) {
      const HomeArrow end{run.end.translation(), run.end.heading, run.headingError()};
      picture.fields.push_back({run.home.translation(), {end}, run.way});
    }
  }
  picture.title = std::to_string(picture.fields.size()) + " of " + std::to_string(runs.size()) +
                  " drives that did not arrive: way and last heading";
  if (!picture.fields.empty()) {
    writeText(file, std::filesystem::path(file).extension() == ".svg"
                        ? homeVectorSvg(picture)
                        : encodePng(homeVectorImage(picture)));
  }
}

void say(const std::vector<ArrivalRun> &runs, const ArrivalScore &score)
{
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].arrived()) {
      std::printf("run %zu from %.2f,%.2f to %.2f,%.2f: %s after %.0f s, %.2f m off\n", i,
                  runs[i].start.x, runs[i].start.y, runs[i].home.x, runs[i].home.y,
                  name(runs[i].outcome), runs[i].seconds, runs[i].error());
    }
  }
  std::printf("%zu of %zu arrived, %zu were elsewhere when they said so; median error %.3f m and "
              "%.2f degrees after %.0f s, %d collisions\n",
              score.arrived, score.runs, score.wronglyArrived, score.medianError,
              score.medianHeadingDeg, score.medianSeconds, score.collisions);
}

void evaluateArrival(const ArrivalArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  const SimulatedRobot simulated(arguments.simulation);
  RobotDescription robot = simulated.robot();
  robot.rMp.translation().x() += arguments.mirrorAhead;
  robot.rMp.rotate(
      Eigen::AngleAxisd(radians(arguments.mirrorYawDegrees), Eigen::Vector3d::UnitZ()));
  PilotOptions pilot;
  pilot.homingMethod = arguments.homing;
  ArrivalOptions options = arguments.options;
  options.seed = arguments.simulation.seed;
  options.threads = arguments.simulation.threads;
  options.mapLight = parseLightPreset(arguments.lightMap);
  options.nowLight = parseLightPreset(arguments.lightNow);
  const std::vector<ArrivalRun> runs =
      driveHome(simulated.sharedScene(), robot, simulated.camera(), pilot, options,
                [](std::size_t done, std::size_t all) {
                  showProgress("drive " + std::to_string(done) + " of " + std::to_string(all));
                });
  endProgress();
  const ArrivalScore score = scoreArrivals(runs);
  nlohmann::json json = jsonHeader("evaluate arrival");
  json["seed"] = options.seed;
  json["light_map"] = arguments.lightMap;
  json["light_now"] = arguments.lightNow;
  json["homing"] = arguments.homing;
  json["score"] = jsonOf(score);
  for (const ArrivalRun &run : runs) {
    json["drives"].push_back(jsonOf(run));
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(arguments.json, json);
  if (!arguments.picture.empty()) {
    drawFailures(arguments.picture, runs, simulated.simulator().freeSpace().floorPlan());
  }
  say(runs, score);
}

} // namespace

void addEvaluateArrivalCommand(CliCommand evaluate)
{
  auto arguments = std::make_shared<ArrivalArguments>();
  CliCommand command = evaluate.command("arrival", "Drives home by sight, to their end");
  command.examples("Example: homeward evaluate arrival --world house.world --runs 200 "
                   "--picture failures.png --json arrival.json");
  addSimulationArguments(command, arguments->simulation);
  command.remove("--light");
  command.remove("--start");
  command.option("--runs", arguments->options.runs, "Drives").between(1, 100000).showDefault();
  command.option("--farthest", arguments->options.farthest, "Metres from home, at most")
      .between(0.5, 10.0)
      .showDefault();
  command.option("--light-map", arguments->lightMap, "Light when the homes were seen")
      .showDefault();
  command.option("--light-now", arguments->lightNow, "Light when the robot drives home")
      .showDefault();
  command.option("--homing", arguments->homing, "How the robot finds home by sight")
      .oneOf(homingMethodNames())
      .showDefault();
  command.option("--mirror-ahead", arguments->mirrorAhead,
                 "Metres that the mirror stands ahead of where the robot file has it");
  command.option("--mirror-yaw", arguments->mirrorYawDegrees,
                 "Degrees that it is turned to the left");
  command
      .option("--proxy-factor", arguments->options.proxyFactor,
              "Distances come out so many times too large")
      .between(0.01, 100.0)
      .showDefault();
  command.option("--picture", arguments->picture,
                 "Draw the drives that did not arrive, .svg or .png");
  command.json(arguments->json, "all drives");
  command.run([arguments] {
    evaluateArrival(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
