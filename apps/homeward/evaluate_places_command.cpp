// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_setup.h"
#include "view_source.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/place_trial.h>
#include <homeward/viewer/bar_chart.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>

namespace homeward
{
namespace
{

struct PlacesArguments
{
  SimulationArguments simulation;
  std::string data;
  std::string json;
  std::string picture;
  std::vector<std::string> lightsMap{"day"};
  std::vector<std::string> lightsNow; ///< empty: all there are
  std::vector<std::string> signatures;
  std::vector<std::string> warping{"aligned_edges"};
  std::string network;
  int networkSize = EmbeddingOptions{}.input.width;
  double spacing = 0.9;
  double sameDistance = 1.0;
  std::size_t queries = 100;
  SceneChange change; ///< from when places became known to when they are looked for
};

/** Views by light. Of a data set, known views and queries are the same objects. */
struct Subject
{
  std::map<std::string, PlaceViews> known;
  std::map<std::string, PlaceViews> queries; ///< empty: the known ones
  std::vector<std::string> lights;

  const PlaceViews &queriesOf(const std::string &light) const
  {
    return queries.empty() ? known.at(light) : queries.at(light);
  }
};

Subject readSubject(const PlacesArguments &arguments)
{
  const DataSet set = DataSet::read(arguments.data);
  Subject subject;
  subject.lights = set.lights();
  for (const std::string &light : subject.lights) {
    subject.known.emplace(light, placeViews(set, light));
  }
  return subject;
}

PlaceViews render(const ViewSource &source, const std::vector<Pose2> &poses,
                  const std::string &light)
{
  DataSet set(source.camera);
  addRenderedViews(set, source, poses, parseLightPreset(light), renderProgress());
  set.followRim();
  return placeViews(set, light);
}

Subject renderSubject(const PlacesArguments &arguments)
{
  SimulatedRobot robot(arguments.simulation);
  ViewSource source = viewSource(robot, arguments.simulation);
  source.colour = true;
  const FreeSpace &space = robot.simulator().freeSpace();
  const std::vector<Pose2> grid = gridPoses(space, arguments.spacing, source.seed);
  const std::vector<Pose2> random = randomPoses(space, arguments.queries, source.seed);
  Subject subject;
  subject.lights = {"day", "twilight", "night", "two_lamps"};
  for (const std::string &light : arguments.lightsMap) {
    subject.known.emplace(light, render(source, grid, light));
  }
  source.seed += 1; // other noise; the optics are of the same making
  applyChange(source, robot, random, arguments.change);
  for (const std::string &light :
       arguments.lightsNow.empty() ? subject.lights : arguments.lightsNow) {
    subject.queries.emplace(light, render(source, random, light));
  }
  return subject;
}

nlohmann::json jsonOf(const PlaceFigures &figures)
{
  const PlaceScore &score = figures.score;
  nlohmann::json json = {{"queries", score.queries},
                         {"recall_at_1", score.recallAt1},
                         {"recall_at_5", score.recallAt5},
                         {"recall_at_20", score.recallAt20},
                         {"recall_at_full_precision", score.recallAtFullPrecision},
                         {"auc_pr", score.aucPr},
                         {"first_by_distance", nlohmann::json::object()},
                         {"bytes", figures.bytes},
                         {"us_per_query", figures.microsecondsPerQuery}};
  for (std::size_t i = 0; i < score.confusion.size(); ++i) {
    std::array<char, 24> name{};
    const bool last = i == kConfusionDistances.size();
    std::snprintf(name.data(), name.size(), last ? "beyond_%.1f_m" : "to_%.1f_m",
                  kConfusionDistances.at(last ? i - 1 : i));
    json["first_by_distance"][name.data()] = score.confusion[i];
  }
  if (figures.sure) {
    json["sure_matches"] = figures.sure->matches;
    json["sure_and_right"] = figures.sure->right;
    json["sure_pairs"] = figures.surePairs->matches;
    json["sure_pairs_and_right"] = figures.surePairs->right;
  }
  return json;
}

void printFigures(const std::string &name, const PlaceFigures &figures)
{
  const PlaceScore &score = figures.score;
  std::printf("%-22s %6.1f %6.1f %6.1f %9.1f %8.3f %7zu %10.1f\n", name.c_str(),
              100.0 * score.recallAt1, 100.0 * score.recallAt5, 100.0 * score.recallAt20,
              100.0 * score.recallAtFullPrecision, score.aucPr, figures.bytes,
              figures.microsecondsPerQuery);
  if (figures.sure) {
    std::printf(
        "  given 0.9 or more: %zu first candidates, %zu of them right; %zu candidates in all, "
        "%zu right\n",
        figures.sure->matches, figures.sure->right, figures.surePairs->matches,
        figures.surePairs->right);
  }
}

nlohmann::json evaluatePair(const PlacesArguments &arguments, const PlaceViews &known,
                            const PlaceViews &queries, const EmbeddingNetwork *network)
{
  PlaceTrialOptions options;
  options.sameDistance = arguments.sameDistance;
  options.threads = arguments.simulation.threads;
  const PlaceTrial trial(known, queries, options);
  nlohmann::json signatures;
  const auto add = [&](const std::string &name, const PlaceFigures &figures) {
    signatures[name] = jsonOf(figures);
    printFigures(name, figures);
  };
  for (const std::string &signature : arguments.signatures) {
    add(signature, trial.bySignature(parseSignatureKind(signature)));
  }
  if (network != nullptr) {
    add("embedding", trial.byNetwork(*network));
  }
  for (const std::string &signature : arguments.warping) {
    showProgress(signature + ", ranked again by min-warping");
    const PlaceFigures figures = trial.byWarping(parseSignatureKind(signature));
    endProgress();
    add(signature + "+warping", figures);
  }
  return signatures;
}

/** Recall@1 of every signature, a group of bars a pair of lights. */
BarChart chartOf(const nlohmann::json &pairs)
{
  BarChart chart{"Places found first (recall@1)", {}, {}};
  for (const nlohmann::json &pair : pairs) {
    BarChart::Group group{
        pair["light_map"].get<std::string>() + " to " + pair["light_now"].get<std::string>(), {}};
    chart.series.clear();
    for (const auto &[name, figures] : pair["signatures"].items()) {
      chart.series.push_back(name);
      group.values.push_back(figures["recall_at_1"].get<double>());
    }
    chart.groups.push_back(group);
  }
  return chart;
}

void requireLight(const Subject &subject, const std::string &light)
{
  if (std::find(subject.lights.begin(), subject.lights.end(), light) == subject.lights.end()) {
    std::string known;
    for (const std::string &other : subject.lights) {
      known += (known.empty() ? "" : ", ") + other;
    }
    throw ConfigError("no picture was taken by the light '" + light + "', but by " + known);
  }
}

void evaluatePlaces(const PlacesArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  std::unique_ptr<EmbeddingNetwork> network;
  if (!arguments.network.empty()) {
    EmbeddingOptions embedding;
    embedding.input = {arguments.networkSize, arguments.networkSize};
    network = std::make_unique<EmbeddingNetwork>(arguments.network, embedding);
  }
  const Subject subject =
      arguments.data.empty() ? renderSubject(arguments) : readSubject(arguments);
  nlohmann::json json = jsonHeader("evaluate places");
  json["seed"] = arguments.simulation.seed;
  json["light_pairs"] = nlohmann::json::array();
  for (const std::string &lightMap : arguments.lightsMap) {
    requireLight(subject, lightMap);
    for (const std::string &lightNow :
         arguments.lightsNow.empty() ? subject.lights : arguments.lightsNow) {
      requireLight(subject, lightNow);
      const PlaceViews &known = subject.known.at(lightMap);
      const PlaceViews &queries = subject.queriesOf(lightNow);
      std::printf("%s to %s: %zu known views, %zu looked for, right within %.2f m\n",
                  lightMap.c_str(), lightNow.c_str(), known.poses.size(), queries.poses.size(),
                  arguments.sameDistance);
      std::printf("%-22s %6s %6s %6s %9s %8s %7s %10s\n", "", "@1 %", "@5 %", "@20 %", "@full %",
                  "auc_pr", "bytes", "us/query");
      json["light_pairs"].push_back(
          {{"light_map", lightMap},
           {"light_now", lightNow},
           {"known", known.poses.size()},
           {"signatures", evaluatePair(arguments, known, queries, network.get())}});
    }
  }
  if (!arguments.picture.empty()) {
    writeText(arguments.picture, barChartSvg(chartOf(json["light_pairs"])));
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(arguments.json, json);
}

std::vector<std::string> signatureNames()
{
  std::vector<std::string> names;
  for (const SignatureTraits &kind : signatureKinds()) {
    names.emplace_back(kind.name);
  }
  return names;
}

} // namespace

void addEvaluatePlacesCommand(CliCommand evaluate)
{
  auto arguments = std::make_shared<PlacesArguments>();
  arguments->signatures = signatureNames();
  CliCommand command = evaluate.command("places", "How well places are recognised");
  command.examples("Example: homeward evaluate places --world house.world --lights-map day "
                   "--lights-now night two_lamps --json places.json");
  addSimulationArguments(command, arguments->simulation);
  command.remove("--light");
  command.option("--data", arguments->data, "Data set folder, instead of a world")
      .excludes("--world");
  command.option("--lights-map", arguments->lightsMap, "Lights in which places became known")
      .showDefault();
  command.option("--lights-now", arguments->lightsNow,
                 "Lights in which they are looked for (default: all)");
  command.option("--spacing", arguments->spacing, "Metres between the known places of a world")
      .between(0.3, 10.0)
      .showDefault();
  command.option("--queries", arguments->queries, "Random places looked for in a world")
      .between(1, 100000)
      .showDefault();
  addSceneChange(command, arguments->change);
  command.option("--same", arguments->sameDistance, "Metres within which an answer is right")
      .between(0.05, 100.0)
      .showDefault();
  command.option("--signatures", arguments->signatures, "What is compared")
      .oneOf(signatureNames())
      .showDefault();
  command
      .option("--warping", arguments->warping,
              "Signatures whose best 20 are ranked again by min-warping")
      .oneOf(signatureNames())
      .count(0, 100)
      .showDefault();
  command.option("--network", arguments->network, "ONNX file of a network that embeds pictures");
  command.option("--network-size", arguments->networkSize, "Width and height of its input, pixels")
      .between(1, 4096)
      .showDefault();
  command.option("--picture", arguments->picture, "Draw recall@1 by light and signature, .svg");
  command.json(arguments->json, "the figures");
  command.run([arguments] {
    evaluatePlaces(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
