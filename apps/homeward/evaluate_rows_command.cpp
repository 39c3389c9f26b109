// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_setup.h"
#include "view_source.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/place_trial.h>
#include <homeward/evaluation/row_trials.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

namespace homeward
{
namespace
{

struct RowsArguments
{
  SimulationArguments simulation;
  std::string json;
  std::vector<std::string> signatures{"jeffrey", "chi_square", "sad", "fourier", "aligned_edges"};
  std::vector<std::string> lights{"night", "twilight", "two_lamps"};
  std::size_t drives = 20;
  double lightDistance = 0.3;
  bool published = false;
  double pixels = BayesOptions{}.publishedPixels;
};

/** A row as a column of the table: how far off and in which light it became known. */
struct Column
{
  std::size_t distance = 0; ///< index
  std::string light;
};

/** Success ratios of all drives, by signature and column. */
using Ratios = std::map<std::pair<std::string, std::size_t>, std::vector<double>>;

class RowEvaluation
{
public:
  explicit RowEvaluation(const RowsArguments &arguments)
      : m_arguments(arguments), m_robot(arguments.simulation),
        m_source(viewSource(m_robot, arguments.simulation))
  {
    m_source.colour = true;
    for (std::size_t i = 0; i < m_options.distances.size(); ++i) {
      m_columns.push_back({i, "day"});
    }
    for (const std::string &light : arguments.lights) {
      parseLightPreset(light);
      m_columns.push_back({indexOf(arguments.lightDistance), light});
    }
  }

  void run()
  {
    const std::vector<RowPoses> drives =
        placeRows(m_robot.simulator().freeSpace(), m_arguments.drives, m_source.seed, m_options);
    if (drives.empty()) {
      throw ConfigError("no straight drive of 4.5 m fits in world " + m_robot.worldFile() +
                        "; use a larger one");
    }
    std::size_t done = 0;
    for (const RowPoses &drive : drives) {
      judge(drive);
      showProgress("drives " + std::to_string(++done) + " of " + std::to_string(drives.size()));
    }
    endProgress();
    m_drives = drives.size();
  }

  void print() const
  {
    std::printf("%zu drives; share of pictures for which the most probable known one is the "
                "nearest, %%\n%-14s",
                m_drives, "");
    for (const Column &column : m_columns) {
      std::printf(" %9s", title(column).c_str());
    }
    std::printf("\n");
    for (const std::string &signature : m_arguments.signatures) {
      std::printf("%-14s", signature.c_str());
      for (std::size_t i = 0; i < m_columns.size(); ++i) {
        std::printf(" %9.1f", 100.0 * mean(signature, i));
      }
      std::printf("\n");
    }
    std::printf("%-14s", "rows");
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      std::printf(" %9zu", m_ratios.at({m_arguments.signatures.front(), i}).size());
    }
    std::printf("\n");
  }

  nlohmann::json json() const
  {
    nlohmann::json json = jsonHeader("evaluate rows");
    json["seed"] = m_arguments.simulation.seed;
    json["drives"] = m_drives;
    json["published_pixels"] = m_arguments.published ? m_arguments.pixels : 0.0;
    json["columns"] = nlohmann::json::array();
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      nlohmann::json column{{"row_distance_m", m_options.distances[m_columns[i].distance]},
                            {"light_map", m_columns[i].light},
                            {"rows", m_ratios.at({m_arguments.signatures.front(), i}).size()}};
      for (const std::string &signature : m_arguments.signatures) {
        column["success_ratio"][signature] = mean(signature, i);
      }
      json["columns"].push_back(column);
    }
    return json;
  }

private:
  std::size_t indexOf(double distance) const
  {
    for (std::size_t i = 0; i < m_options.distances.size(); ++i) {
      if (std::abs(m_options.distances[i] - distance) < 1e-6) {
        return i;
      }
    }
    throw ConfigError("no row is " + std::to_string(distance) + " m from the drive");
  }

  std::string title(const Column &column) const
  {
    const auto centimetres = std::lround(100.0 * m_options.distances[column.distance]);
    return column.light == "day" ? std::to_string(centimetres) + " cm" : column.light;
  }

  PlaceViews render(const std::vector<Pose2> &poses, const std::string &light)
  {
    ++m_source.noiseStream;
    DataSet set(m_source.camera);
    addRenderedViews(set, m_source, poses, parseLightPreset(light));
    set.followRim();
    return placeViews(set, light);
  }

  void judge(const RowPoses &drive)
  {
    const PlaceViews seen = render(drive.seen, "day");
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      const std::vector<Pose2> &row = drive.known[m_columns[i].distance];
      const PlaceViews known = row.empty() ? PlaceViews{} : render(row, m_columns[i].light);
      for (const std::string &signature : m_arguments.signatures) {
        std::vector<double> &ratios = m_ratios[{signature, i}];
        if (!row.empty()) {
          ratios.push_back(success(known, seen, parseSignatureKind(signature)));
        }
      }
    }
  }

  double success(const PlaceViews &known, const PlaceViews &seen, SignatureKind kind) const
  {
    const auto signatures = [&](const PlaceViews &views) {
      std::vector<Signature> made;
      for (const Panorama &panorama : views.panoramas) {
        made.push_back(makeSignature(panorama, kind, views.visible));
      }
      return made;
    };
    BayesOptions options;
    options.kernel = m_arguments.published ? BayesKernel::Published : BayesKernel::Gaussian;
    options.publishedPixels = m_arguments.pixels;
    return rowSuccess(known.poses, signatures(known), seen.poses, signatures(seen), options);
  }

  double mean(const std::string &signature, std::size_t column) const
  {
    const std::vector<double> &ratios = m_ratios.at({signature, column});
    double sum = 0.0;
    for (const double ratio : ratios) {
      sum += ratio;
    }
    return ratios.empty() ? std::nan("") : sum / static_cast<double>(ratios.size());
  }

  const RowsArguments &m_arguments;
  RowOptions m_options;
  SimulatedRobot m_robot;
  ViewSource m_source;
  std::vector<Column> m_columns;
  Ratios m_ratios;
  std::size_t m_drives = 0;
};

void evaluateRows(const RowsArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  RowEvaluation evaluation(arguments);
  evaluation.run();
  if (arguments.json != "-") {
    evaluation.print();
  }
  nlohmann::json json = evaluation.json();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(arguments.json, json);
}

} // namespace

void addEvaluateRowsCommand(CliCommand evaluate)
{
  auto arguments = std::make_shared<RowsArguments>();
  CliCommand command =
      evaluate.command("rows", "How well drives are localized beside rows of known places");
  command.examples("Example: homeward evaluate rows --world house.world --published\n"
                   "16 pictures of a drive, 30 cm apart, by day; 6 known ones, 90 cm apart, on\n"
                   "rows 0 to 180 cm beside it; a Bayes filter that starts anywhere.");
  addSimulationArguments(command, arguments->simulation);
  command.remove("--light");
  command.option("--drives", arguments->drives, "Random drives that are averaged")
      .between(1, 1000)
      .showDefault();
  command.option("--lights", arguments->lights, "Lights in which a near row became known, too")
      .showDefault();
  command.option("--light-distance", arguments->lightDistance, "Metres from the drive to that row")
      .showDefault();
  command.option("--signatures", arguments->signatures, "What is compared").showDefault();
  command.flag("--published", arguments->published,
               "The kernel as published: a distance, not its square, over the variance");
  command.option("--pixels", arguments->pixels, "Of --published: pixels of the counts it stands on")
      .between(1e-6, 1e9)
      .showDefault();
  command.json(arguments->json, "the figures");
  command.run([arguments] {
    evaluateRows(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
