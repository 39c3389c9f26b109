// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/truth_log.h>

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <fstream>

namespace homeward
{
namespace fs = std::filesystem;
using nlohmann::json;

namespace
{

json poseJson(const Pose2 &pose)
{
  return {pose.x, pose.y, pose.heading};
}

Pose2 poseFrom(const json &value)
{
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

} // namespace

fs::path truthLogFile(const fs::path &map)
{
  return map.string() + ".truth.json";
}

void saveTruthLog(const fs::path &file, const TruthLog &log)
{
  json text{{"world", log.world},
            {"robot", log.robot},
            {"light", log.light},
            {"seed", log.seed},
            {"forward_distance_m", log.forwardDistance},
            {"start_x_m_y_m_heading_rad", poseJson(log.start)},
            {"end_x_m_y_m_heading_rad", poseJson(log.end)}};
  text["nodes"] = json::array();
  for (const auto &[id, pose] : log.nodes) {
    text["nodes"].push_back({{"id", id.value}, {"pose", poseJson(pose)}});
  }
  text["path"] = json::array();
  for (const Eigen::Vector2d &point : log.path) {
    text["path"].push_back({point.x(), point.y()});
  }
  const fs::path part = file.string() + ".part";
  std::ofstream stream(part, std::ios::binary);
  stream << text.dump(1) << '\n';
  stream.close();
  std::error_code error;
  if (stream) {
    fs::rename(part, file, error);
  }
  if (!stream || error) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw StoreError("cannot write " + file.string() +
                     "; check that the folder exists and has room");
  }
}

std::optional<TruthLog> loadTruthLog(const fs::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return std::nullopt;
  }
  try {
    const json text = json::parse(stream);
    TruthLog log;
    log.world = text.at("world").get<std::string>();
    log.robot = text.at("robot").get<std::string>();
    log.light = text.at("light").get<std::string>();
    log.seed = text.at("seed").get<std::uint64_t>();
    log.forwardDistance = text.at("forward_distance_m").get<double>();
    log.start = poseFrom(text.at("start_x_m_y_m_heading_rad"));
    log.end = poseFrom(text.at("end_x_m_y_m_heading_rad"));
    for (const json &node : text.at("nodes")) {
      log.nodes[NodeId{node.at("id").get<std::int64_t>()}] = poseFrom(node.at("pose"));
    }
    for (const json &point : text.at("path")) {
      log.path.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
    }
    return log;
  }
  catch (const json::exception &error) {
    throw StoreError(file.string() + " is damaged (" + error.what() +
                     "); delete it or explore again");
  }
}

} // namespace homeward
