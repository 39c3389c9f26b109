// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_setup.h"

#include <homeward/core/error.h>
#include <homeward/laser/carmen_log.h>
#include <homeward/laser/open_directions.h>
#include <homeward/viewer/scan_picture.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

struct ScanArguments
{
  std::string log;
  std::string json;
  std::string picture;
  std::size_t index = 0;
  double forwardDistance = 2.0;
};

void drawScan(const ScanArguments &arguments, const CarmenScan &scan,
              const std::vector<OpenDirection> &directions)
{
  ScanPicture picture;
  picture.title = std::filesystem::path(arguments.log).filename().string() + ", scan " +
                  std::to_string(arguments.index);
  picture.openDirections = directions;
  if (std::filesystem::path(arguments.picture).extension() == ".svg") {
    writeText(arguments.picture, scanSvg(scan.scan, picture));
    return;
  }
  writeText(arguments.picture, encodePng(scanImage(scan.scan, picture)));
}

void scan(const ScanArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  const CarmenLog log = readCarmenLog(arguments.log);
  if (!arguments.picture.empty() && arguments.index >= log.scans.size()) {
    throw ConfigError("--index " + std::to_string(arguments.index) + ": " + arguments.log +
                      " has " + std::to_string(log.scans.size()) + " scans, counted from 0");
  }
  nlohmann::json json = jsonHeader("scan");
  json["log"] = arguments.log;
  json["odometry_lines"] = log.odometryLines;
  json["scans"] = nlohmann::json::array();
  std::size_t found = 0;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const CarmenScan &taken = log.scans[i];
    const std::vector<OpenDirection> directions =
        findOpenDirections(taken.scan, openDirectionOptions(arguments.forwardDistance));
    found += directions.size();
    nlohmann::json entry{
        {"index", i}, {"time_s", taken.time}, {"readings", taken.scan.ranges.size()}};
    entry["directions"] = nlohmann::json::array();
    for (const OpenDirection &direction : directions) {
      entry["directions"].push_back({{"bearing_rad", direction.bearing},
                                     {"width_rad", direction.width},
                                     {"range_m", direction.range}});
    }
    json["scans"].push_back(entry);
    if (!arguments.picture.empty() && i == arguments.index) {
      drawScan(arguments, taken, directions);
    }
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = wall.count();
  writeJson(arguments.json, json);
  std::printf(
      "%s: scans %zu, odometry lines %zu, open directions %zu (%.1f a scan)\n",
      arguments.log.c_str(), log.scans.size(), log.odometryLines, found,
      log.scans.empty() ? 0.0 : static_cast<double>(found) / static_cast<double>(log.scans.size()));
}

} // namespace

void addScanCommand(CliCommand app)
{
  auto arguments = std::make_shared<ScanArguments>();
  CliCommand command = app.command("scan", "Open directions of the scans of a CARMEN log");
  command.examples("Example: homeward scan intel.log.gz --picture scan.png --index 100");
  command.option("log", arguments->log, "CARMEN log, plain or .gz").required();
  command.json(arguments->json, "every scan's directions");
  command.option("--picture", arguments->picture, "Draw one scan, .svg or .png");
  command.option("--index", arguments->index, "Scan to draw, counted from 0").showDefault();
  command.option("--forward-distance", arguments->forwardDistance, "Metres a direction is driven")
      .between(0.5, 20.0)
      .showDefault();
  command.run([arguments] {
    scan(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
