// SPDX-License-Identifier: GPL-3.0-or-later
#include "dashboard_json.h"

#include <homeward/topology/reckoning.h>
#include <homeward/viewer/map_layout.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>

namespace homeward
{
namespace
{

using nlohmann::json;

std::string text(const json &value)
{
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/** So many digits as people can see. */
double rounded(double value, double step)
{
  return std::round(value / step) * step;
}

std::string base64(const std::vector<unsigned char> &bytes)
{
  constexpr const char *kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string digits;
  digits.reserve(bytes.size() * 4 / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < left ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      digits += k <= left ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return digits;
}

json stateOf(const MissionScene &scene)
{
  json state{{"seconds", rounded(scene.seconds, 0.1)},
             {"words", scene.state},
             {"why", scene.reason},
             {"battery", scene.battery ? json(rounded(*scene.battery, 0.1)) : json()},
             {"view_age", rounded(scene.viewAge, 0.1)},
             {"scan_age", rounded(scene.scanAge, 0.1)},
             {"route", json::array()}};
  for (const NodeId node : scene.route) {
    state["route"].push_back(node.value);
  }
  if (!scene.speeds.empty()) {
    const SpeedSample &now = scene.speeds.back();
    state["told"] = {rounded(now.told.v, 0.001), rounded(now.told.w, 0.001)};
    state["sure"] = rounded(now.sure, 0.01);
    state["driven"] = {rounded(now.measured.v, 0.001), rounded(now.measured.w, 0.001)};
  }
  return state;
}

json viewOf(const MissionScene &scene)
{
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", scene.view.image, jpeg, {cv::IMWRITE_JPEG_QUALITY, 75});
  json view{
      {"jpeg", base64(jpeg)}, {"goal", scene.goal}, {"home", nullptr}, {"alike", json::array()}};
  if (scene.home) {
    view["home"] = rounded(*scene.home, 0.001);
  }
  for (const auto &[node, probability] : scene.alike) {
    view["alike"].push_back({node.value, rounded(probability, 0.001)});
  }
  return view;
}

json scanOf(const MissionScene &scene)
{
  json scan{{"angle_min", scene.scan->angleMin},
            {"angle_step", scene.scan->angleStep},
            {"range_max", scene.scan->rangeMax},
            {"ranges", json::array()},
            {"open", json::array()}};
  for (const float range : scene.scan->ranges) {
    scan["ranges"].push_back(std::isfinite(range) ? json(rounded(range, 0.01)) : json());
  }
  for (const OpenDirection &open : scene.openDirections) {
    scan["open"].push_back({open.bearing, open.width, open.range});
  }
  return scan;
}

/** Of each node in metres and radians. */
std::map<NodeId, Pose2> placesOf(const TopologicalMap &map)
{
  std::map<NodeId, Pose2> places;
  if (map.nodes().empty()) {
    return places;
  }
  const Reckoning reckoning(map, map.nodes().begin()->first);
  for (const auto &[id, node] : map.nodes()) {
    const std::optional<Reckoned> reckoned = reckoning.find(id);
    if (!reckoned) {
      return layOut(map);
    }
    places[id] = reckoned->fromMto;
  }
  return places;
}

json nodeOf(const Node &node, const Pose2 &place, bool hasView)
{
  json directions = json::array();
  for (const Direction &direction : node.directions) {
    directions.push_back({{"bearing", rounded(direction.bearing, 0.001)},
                          {"width", rounded(direction.width, 0.001)},
                          {"state", name(direction.state)},
                          {"reason", direction.reason}});
  }
  return {{"id", node.id.value},
          {"name", node.name},
          {"x", rounded(place.x, 0.001)},
          {"y", rounded(place.y, 0.001)},
          {"heading", rounded(place.heading, 0.001)},
          {"view", hasView},
          {"directions", directions}};
}

json edgeOf(const Edge &edge)
{
  return {{"a", edge.a.value},
          {"b", edge.b.value},
          {"length", edge.length ? json(rounded(*edge.length, 0.01)) : json()},
          {"tries", edge.statistics.tries},
          {"successes", edge.statistics.successes},
          {"seconds", rounded(edge.statistics.meanSeconds, 0.1)},
          {"error", edge.statistics.lastError},
          {"forbidden", edge.forbidden}};
}

} // namespace

std::map<std::string, std::string> sceneJson(const MissionScene &scene)
{
  std::map<std::string, std::string> events{{"state", text(stateOf(scene))}};
  if (!scene.view.image.empty()) {
    events["view"] = text(viewOf(scene));
  }
  if (scene.scan) {
    events["scan"] = text(scanOf(scene));
  }
  return events;
}

std::string mapJson(const MapFile &file)
{
  const std::map<NodeId, Pose2> places = placesOf(file.map());
  json map{{"file", file.path().filename().string()},
           {"nodes", json::array()},
           {"edges", json::array()},
           {"edits", json::array()}};
  for (const auto &[id, node] : file.map().nodes()) {
    map["nodes"].push_back(nodeOf(node, places.at(id), file.hasView(id)));
  }
  for (const auto &[id, edge] : file.map().edges()) {
    map["edges"].push_back(edgeOf(edge));
  }
  for (const JournalEntry &entry : file.journal()) {
    if (!entry.undone) {
      map["edits"].push_back(entry.description);
    }
  }
  return text(map);
}

} // namespace homeward
