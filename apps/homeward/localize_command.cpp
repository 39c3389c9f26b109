// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"

#include <homeward/core/error.h>
#include <homeward/dataset/data_set.h>
#include <homeward/evaluation/localization_run.h>
#include <homeward/store/map_file.h>
#include <homeward/topology/planner.h>
#include <homeward/viewer/belief_picture.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>

namespace homeward
{
namespace
{

namespace fs = std::filesystem;

struct LocalizeArguments
{
  std::string train;
  std::string test;
  std::string signature = "aligned_edges";
  std::string json;
  bool global = false;
  bool local = false;
  bool published = false;
  double kidnapping = 0.01;
  std::string picture;
};

/** Known places; where they are is known of a data set, not of a map. */
struct Training
{
  KnownPlaces known;
  std::vector<Pose2> poses; ///< empty for a map
};

Training trainOnViews(const DataSet &set, SignatureKind kind)
{
  Training training;
  for (std::size_t i = 0; i < set.size(); ++i) {
    training.known.nodes.push_back(NodeId{static_cast<std::int64_t>(i)});
    training.known.signatures.push_back(makeSignature(set.colourPanorama(i), kind, set.visible()));
    training.poses.push_back(set.view(i).pose);
  }
  training.known.steps = stepsBetween(training.poses);
  return training;
}

Training trainOnMap(const MapFile &map, SignatureKind kind, const cv::Mat &visible)
{
  Training training;
  KnownPlaces &known = training.known;
  for (const auto &[id, node] : map.map().nodes()) {
    known.nodes.push_back(id);
    known.signatures.push_back(makeSignature(map.panorama(id), kind, visible));
  }
  const auto count = static_cast<Eigen::Index>(known.nodes.size());
  known.steps = Eigen::MatrixXd::Constant(count, count, std::numeric_limits<double>::infinity());
  for (Eigen::Index from = 0; from < count; ++from) {
    const auto steps = stepDistances(map.map(), known.nodes[static_cast<std::size_t>(from)]);
    for (Eigen::Index to = 0; to < count; ++to) {
      const auto found = steps.find(known.nodes[static_cast<std::size_t>(to)]);
      known.steps(to, from) =
          found == steps.end() ? std::numeric_limits<double>::infinity() : found->second;
    }
  }
  return training;
}

void requireViews(std::size_t count, const std::string &where)
{
  if (count == 0) {
    throw ConfigError(where + " holds no view of any place");
  }
}

/** Both read; the pictures of both must become panoramas of one geometry. */
std::pair<Training, DataSet> readBoth(const LocalizeArguments &arguments, SignatureKind kind)
{
  if (!fs::is_directory(arguments.train)) {
    const MapFile map = MapFile::open(arguments.train, MapFile::Access::Read);
    requireViews(map.map().nodes().size(), arguments.train);
    DataSet test = DataSet::read(arguments.test, map.header().panorama);
    if (!(test.geometry() == map.header().panorama)) {
      throw ConfigError("the panoramas of " + arguments.test + " and of the map " +
                        arguments.train + " have different sizes or elevations");
    }
    return {trainOnMap(map, kind, test.visible()), std::move(test)};
  }
  const DataSet train = DataSet::read(arguments.train);
  DataSet test = DataSet::read(arguments.test);
  if (!(test.geometry() == train.geometry())) {
    throw ConfigError("the panoramas of " + arguments.test + " and " + arguments.train +
                      " have different sizes or elevations");
  }
  requireViews(train.size(), arguments.train);
  return {trainOnViews(train, kind), std::move(test)};
}

void drawBeliefs(const std::string &file, const Training &training, const DataSet &test,
                 const std::vector<Localization> &found)
{
  std::vector<BeliefRow> rows;
  for (std::size_t i = 0; i < found.size(); ++i) {
    rows.push_back({found[i].belief, std::nullopt});
    if (!training.poses.empty()) {
      rows.back().truth = nearestPlace(training.poses, test.view(i).pose);
    }
  }
  writeText(file, encodePicture(file, beliefPicture(rows)));
}

void localizeImages(const LocalizeArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  const SignatureKind kind = parseSignatureKind(arguments.signature);
  const auto [training, test] = readBoth(arguments, kind);
  requireViews(test.size(), arguments.test);
  if (arguments.local && training.poses.empty()) {
    throw ConfigError("--local needs places of known positions, the map " + arguments.train +
                      " has none; use --global");
  }
  std::vector<Signature> seen;
  for (std::size_t i = 0; i < test.size(); ++i) {
    seen.push_back(makeSignature(test.colourPanorama(i), kind, test.visible()));
  }
  const auto truth = [&poses = training.poses, &views = test](std::size_t i) {
    return NodeId{static_cast<std::int64_t>(nearestPlace(poses, views.view(i).pose))};
  };
  BayesOptions options;
  options.kernel = arguments.published ? BayesKernel::Published : BayesKernel::Gaussian;
  options.kidnapping = arguments.published ? 0.0 : arguments.kidnapping;
  const std::vector<Localization> found =
      localize(training.known, seen,
               arguments.local ? std::optional<NodeId>(truth(0)) : std::nullopt, options);

  nlohmann::json json = jsonHeader("localize");
  json["signature"] = arguments.signature;
  json["images"] = nlohmann::json::array();
  std::size_t right = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    nlohmann::json image{{"file", test.view(i).file},
                         {"node", found[i].node.value},
                         {"probability", found[i].probability},
                         {"kidnapped", found[i].kidnapped},
                         {"correct", nullptr}};
    if (!training.poses.empty()) {
      const bool correct = truth(i) == found[i].node;
      image["correct"] = correct;
      right += correct ? 1 : 0;
    }
    json["images"].push_back(image);
  }
  const double ratio = static_cast<double>(right) / static_cast<double>(found.size());
  json["success_ratio"] = training.poses.empty() ? nlohmann::json() : nlohmann::json(ratio);
  if (!arguments.picture.empty()) {
    drawBeliefs(arguments.picture, training, test, found);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(arguments.json, json);
  if (arguments.json == "-") {
    return;
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::printf("%s: node %lld, probability %.3f%s\n", test.view(i).file.c_str(),
                static_cast<long long>(found[i].node.value), found[i].probability,
                found[i].kidnapped > 0.5 ? ", carried here from elsewhere" : "");
  }
  if (!training.poses.empty()) {
    std::printf("%zu of %zu right (%.2f %%)\n", right, found.size(), 100.0 * ratio);
  }
}

} // namespace

void addLocalizeCommand(CliCommand app)
{
  auto arguments = std::make_shared<LocalizeArguments>();
  CliCommand command =
      app.command("localize", "Where pictures, taken one after the other, were taken");
  command.examples("Example: homeward localize --train places --test drive --json -");
  command.option("--train", arguments->train, "Data set folder or map of known places").required();
  command.option("--test", arguments->test, "Data set folder, in the order of poses.csv")
      .required();
  command.option("--signature", arguments->signature, "How views are compared").showDefault();
  command.flag("--global", arguments->global, "Start anywhere (the default)");
  command.flag("--local", arguments->local, "Start at the place nearest to the first picture")
      .excludes("--global");
  command.flag("--published", arguments->published,
               "The kernel as published: a distance, not its square, over the variance");
  command
      .option(
          "--kidnapping", arguments->kidnapping,
          "Probability that the robot is carried elsewhere between two pictures; 0 if published")
      .between(0.0, 0.99)
      .showDefault();
  command.option("--picture", arguments->picture, "Draw what was believed when, .png");
  command.json(arguments->json, "the answers");
  command.run([arguments] {
    localizeImages(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
