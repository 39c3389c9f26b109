// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_setup.h"
#include "view_source.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/homing_run.h>
#include <homeward/evaluation/rendered_homing.h>
#include <homeward/viewer/home_vector_picture.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

constexpr std::size_t kMostPanels = 6; // homes in the picture

struct HomingArguments
{
  SimulationArguments simulation;
  std::string data;
  std::string lightMap = "day";
  std::string lightNow = "day";
  std::string json;
  std::string picture;
  std::vector<std::string> methods = homingMethods();
  std::size_t pairs = 500;
  double spacing = 0.5;
};

/** What is measured, and the floor it stands on where that is known. */
struct Subject
{
  HomingTask task;
  std::shared_ptr<const DataSet> set; ///< that the task reads, if any
  std::optional<FloorPicture> floor;
  bool inSight = false; ///< pairs are known to see each other
};

Subject subjectOf(const HomingArguments &arguments)
{
  Subject subject;
  HomingPairOptions pairs;
  pairs.pairs = arguments.pairs;
  if (!arguments.data.empty()) {
    pairs.fewest = 1; // a data set may be small
    subject.set = std::make_shared<const DataSet>(DataSet::read(arguments.data));
    const auto all = [](const Eigen::Vector2d &, const Eigen::Vector2d &) { return true; };
    subject.task = homingTask(*subject.set, arguments.lightMap, arguments.lightNow, all,
                              arguments.simulation.seed, pairs);
    return subject;
  }
  const RenderedHomingOptions options{parseLightPreset(arguments.lightMap),
                                      parseLightPreset(arguments.lightNow), arguments.spacing,
                                      arguments.simulation.seed, pairs};
  SimulatedRobot robot(arguments.simulation);
  const FreeSpace &space = robot.simulator().freeSpace();
  subject.task =
      renderedHomingTask(viewSource(robot, arguments.simulation), space, options, renderProgress());
  const FloorPlan plan = space.floorPlan();
  subject.floor = FloorPicture{plan.image, plan.origin, plan.resolution};
  subject.inSight = true;
  return subject;
}

nlohmann::json jsonOf(const HomingAnswers &answers, const HomingScore &score)
{
  nlohmann::json json{{"pairs", score.pairs},
                      {"unanswered", score.unanswered},
                      {"compass_mean_deg", score.compassMeanDeg},
                      {"compass_median_deg", score.compassMedianDeg},
                      {"ms", answers.milliseconds}};
  if (answers.givesDirection) {
    json["mean_deg"] = score.meanDeg;
    json["median_deg"] = score.medianDeg;
    json["share_over_90"] = score.shareOver90;
    json["return_ratio"] = score.returnRatio;
    json["sure_mean_deg"] = score.sureMeanDeg;
    json["sure_share_over_90"] = score.sureShareOver90;
  }
  return json;
}

void printScore(const HomingAnswers &answers, const HomingScore &score)
{
  std::printf("%-15s", answers.method.c_str());
  if (answers.givesDirection) {
    std::printf(" %6.1f %6.1f %7.1f %7.1f %7.1f %7.2f", score.meanDeg, score.medianDeg,
                100.0 * score.shareOver90, score.sureMeanDeg, 100.0 * score.sureShareOver90,
                score.returnRatio);
  }
  else {
    std::printf(" %6s %6s %7s %7s %7s %7s", "-", "-", "-", "-", "-", "-");
  }
  std::printf(" %7.1f %7.1f %10zu %7.1f\n", score.compassMeanDeg, score.compassMedianDeg,
              score.unanswered, answers.milliseconds);
}

/** The first homes of a task, with what a method answered around them. */
std::vector<HomeVectorField> fieldsOf(const HomingTask &task, const HomingAnswers &answers)
{
  const std::vector<double> errors = directionErrors(task, answers);
  std::vector<HomeVectorField> fields;
  for (std::size_t i = 0; i < task.pairs.size(); ++i) {
    const HomingPair &pair = task.pairs[i];
    if (i == 0 || pair.home != task.pairs[i - 1].home) {
      if (fields.size() == kMostPanels) {
        break;
      }
      fields.push_back({task.homePoses[pair.home].translation(), {}});
    }
    if (const std::optional<HomeVector> &answer = answers.answers[i]) {
      const Pose2 &view = task.viewPoses[pair.view];
      fields.back().arrows.push_back(
          {view.translation(), view.heading + answer->direction, errors[i], answer->confidence});
    }
  }
  return fields;
}

void drawPicture(const HomingArguments &arguments, const Subject &subject,
                 const HomingAnswers &answers)
{
  HomeVectorPicture picture;
  picture.title = answers.method + ", " + arguments.lightMap + " to " + arguments.lightNow;
  picture.floor = subject.floor;
  picture.fields = fieldsOf(subject.task, answers);
  writeText(arguments.picture, std::filesystem::path(arguments.picture).extension() == ".svg"
                                   ? homeVectorSvg(picture)
                                   : encodePng(homeVectorImage(picture)));
}

void evaluateHoming(const HomingArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  const Subject subject = subjectOf(arguments);
  const HomingTask &task = subject.task;
  if (task.pairs.empty()) {
    throw ConfigError("no two views are 0.3 to 2.5 m apart" +
                      std::string(subject.inSight ? " and in sight of each other" : "") +
                      ": more views are needed");
  }
  nlohmann::json pair{{"light_map", arguments.lightMap},
                      {"light_now", arguments.lightNow},
                      {"in_sight", subject.inSight},
                      {"return_ratio_of_truth", returnRatio(task, trueAnswers(task))}};
  std::printf("%s to %s, %zu pairs, %zu views; following the truth returns %.2f\n",
              arguments.lightMap.c_str(), arguments.lightNow.c_str(), task.pairs.size(),
              task.viewPoses.size(), pair["return_ratio_of_truth"].get<double>());
  std::printf("%-15s   mean median >90deg%%  -tenth  >90deg%% return compass  median unanswered"
              "      ms\n",
              "degrees");
  bool drawn = arguments.picture.empty();
  for (const std::string &method : arguments.methods) {
    showProgress(method);
    const HomingAnswers answers = runHoming(method, task, arguments.simulation.threads);
    const HomingScore score = scoreHoming(task, answers);
    pair["methods"][method] = jsonOf(answers, score);
    endProgress();
    printScore(answers, score);
    if (!drawn && answers.givesDirection) {
      drawPicture(arguments, subject, answers);
      drawn = true;
    }
  }
  nlohmann::json json = jsonHeader("evaluate homing");
  json["seed"] = arguments.simulation.seed;
  json["light_pairs"] = nlohmann::json::array({pair});
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(arguments.json, json);
}

} // namespace

void addEvaluateHomingCommand(CliCommand evaluate)
{
  auto arguments = std::make_shared<HomingArguments>();
  CliCommand command = evaluate.command("homing", "Errors of home vectors and compasses");
  command.examples("Example: homeward evaluate homing --world house.world --light-map day "
                   "--light-now night --picture arrows.png --json homing.json");
  addSimulationArguments(command, arguments->simulation);
  command.remove("--light");
  command.option("--data", arguments->data, "Data set folder, instead of a world")
      .excludes("--world");
  command.option("--light-map", arguments->lightMap, "Light when the homes were seen")
      .showDefault();
  command.option("--light-now", arguments->lightNow, "Light when home is looked for").showDefault();
  command.option("--pairs", arguments->pairs, "Pairs at least, while there are any")
      .between(1, 1000000)
      .showDefault();
  command.option("--spacing", arguments->spacing, "Metres between views around a home")
      .between(0.1, 2.0)
      .showDefault();
  command.option("--methods", arguments->methods, "What is compared")
      .oneOf(homingMethods())
      .showDefault();
  command.option("--picture", arguments->picture,
                 "Draw the first method's home vectors around six homes, .svg or .png");
  command.json(arguments->json, "the figures");
  command.run([arguments] {
    evaluateHoming(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
