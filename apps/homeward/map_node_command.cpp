// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "node_argument.h"

#include <homeward/place/place_index.h>
#include <homeward/store/map_file.h>
#include <homeward/upkeep/same_places.h>
#include <homeward/viewer/node_picture.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kMostAlike = 5;

struct NodeArguments
{
  std::string node;
  std::string map;
  std::string picture;
  std::string json;
};

/** "3", or "3 kitchen". */
std::string called(const Node &node)
{
  return std::to_string(node.id.value) + (node.name.empty() ? "" : " " + node.name);
}

/** The places of the map whose panoramas look most like that of the node, best first. */
std::vector<AlikePlace> alikePlacesOf(const MapFile &file, NodeId node)
{
  if (!file.hasView(node)) {
    return {};
  }
  PlaceIndex index(SignatureKind::AlignedEdges);
  for (const auto &[id, other] : file.map().nodes()) {
    if (id != node && file.hasView(id)) {
      index.add(id, makeSignature(file.panorama(id), SignatureKind::AlignedEdges));
    }
  }
  const Panorama panorama = file.panorama(node);
  const Signature signature = makeSignature(panorama, SignatureKind::AlignedEdges);
  std::vector<AlikePlace> alike;
  for (const Match &match : index.nearest(signature, kMostAlike)) {
    alike.push_back({match.node, match.dissimilarity,
                     comparePlaces(panorama, file.panorama(match.node)).probability});
  }
  return alike;
}

std::string degreesText(const std::optional<double> &angle)
{
  if (!angle) {
    return "bearing unknown";
  }
  char text[32];
  std::snprintf(text, sizeof text, "%+.0f deg", degrees(*angle));
  return text;
}

std::string textOf(const Edge &edge)
{
  char text[96];
  std::string words = "length unknown";
  if (edge.length) {
    std::snprintf(text, sizeof text, "%.2f m", *edge.length);
    words = text;
  }
  const EdgeStatistics &drives = edge.statistics;
  words += ", arrived " + std::to_string(drives.successes) + " of " + std::to_string(drives.tries);
  if (drives.successes > 0) {
    std::snprintf(text, sizeof text, ", %.1f s on average", drives.meanSeconds);
    words += text;
  }
  if (!drives.lastError.empty()) {
    words += ", last failure " + drives.lastError;
  }
  return words + (edge.forbidden ? ", no-go" : "");
}

void print(const MapFile &file, const Node &node, const std::vector<AlikePlace> &alike)
{
  const TopologicalMap &map = file.map();
  std::printf("node %s\n", called(node).c_str());
  if (file.hasView(node.id)) {
    const PanoramaGeometry &panorama = file.header().panorama;
    std::printf("panorama %d x %d pixels, %+.0f to %+.0f deg of elevation, %zu bytes\n",
                panorama.width, panorama.height, degrees(panorama.elevationMin),
                degrees(panorama.elevationMax), file.view(node.id).size());
  }
  else {
    std::printf("no panorama\n");
  }
  std::printf("directions %zu\n", node.directions.size());
  for (const Direction &direction : node.directions) {
    std::printf("  %+4.0f deg, %.0f deg wide, %s%s%s\n", degrees(direction.bearing),
                degrees(direction.width), std::string(name(direction.state)).c_str(),
                direction.reason.empty() ? "" : ": ", direction.reason.c_str());
  }
  std::printf("neighbours %zu\n", map.links(node.id).size());
  for (const Link &link : map.links(node.id)) {
    std::printf("  node %s: %s, %s\n", called(map.node(link.to)).c_str(),
                degreesText(map.departureBearing(node.id, link.to)).c_str(),
                textOf(map.edge(link.edge)).c_str());
  }
  std::printf("looks most like %zu\n", alike.size());
  for (const AlikePlace &place : alike) {
    std::printf("  node %s: distance %.3f, the same place with %.1f %%\n",
                called(map.node(place.node)).c_str(), place.distance, 100.0 * place.probability);
  }
}

nlohmann::json jsonOf(const std::optional<double> &value)
{
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json jsonOf(const MapFile &file, const Node &node, const std::vector<AlikePlace> &alike)
{
  const TopologicalMap &map = file.map();
  nlohmann::json json = jsonHeader("map node");
  json["node"] = node.id.value;
  json["name"] = node.name;
  json["panorama"] = nullptr;
  if (file.hasView(node.id)) {
    const PanoramaGeometry &panorama = file.header().panorama;
    json["panorama"] = {{"width", panorama.width},
                        {"height", panorama.height},
                        {"elevation_min_rad", panorama.elevationMin},
                        {"elevation_max_rad", panorama.elevationMax},
                        {"bytes", file.view(node.id).size()}};
  }
  json["directions"] = nlohmann::json::array();
  for (const Direction &direction : node.directions) {
    json["directions"].push_back({{"bearing_rad", direction.bearing},
                                  {"width_rad", direction.width},
                                  {"state", name(direction.state)},
                                  {"reason", direction.reason}});
  }
  json["neighbours"] = nlohmann::json::array();
  for (const Link &link : map.links(node.id)) {
    const Edge &edge = map.edge(link.edge);
    json["neighbours"].push_back({{"node", link.to.value},
                                  {"name", map.node(link.to).name},
                                  {"edge", edge.id.value},
                                  {"bearing_rad", jsonOf(map.departureBearing(node.id, link.to))},
                                  {"length_m", jsonOf(edge.length)},
                                  {"tries", edge.statistics.tries},
                                  {"successes", edge.statistics.successes},
                                  {"mean_s", edge.statistics.meanSeconds},
                                  {"last_error", edge.statistics.lastError},
                                  {"forbidden", edge.forbidden}});
  }
  json["alike"] = nlohmann::json::array();
  for (const AlikePlace &place : alike) {
    json["alike"].push_back({{"node", place.node.value},
                             {"name", map.node(place.node).name},
                             {"distance", place.distance},
                             {"probability", place.probability}});
  }
  return json;
}

void draw(const std::string &output, const MapFile &file, const Node &node,
          const std::vector<AlikePlace> &alike)
{
  NodePicture picture;
  picture.title = "Place " + called(node) + " of " + file.path().stem().string();
  if (file.hasView(node.id)) {
    picture.panorama = file.panorama(node.id);
  }
  picture.alike = alike;
  writeText(output, fs::path(output).extension() == ".svg"
                        ? nodeSvg(file.map(), node.id, picture)
                        : encodePicture(output, nodeImage(file.map(), node.id, picture)));
}

int show(const NodeArguments &arguments)
{
  const MapFile file = MapFile::open(arguments.map, MapFile::Access::Read);
  const Node &node = file.map().node(nodeOf(file, arguments.node));
  const std::vector<AlikePlace> alike = alikePlacesOf(file, node.id);
  print(file, node, alike);
  if (!arguments.picture.empty()) {
    draw(arguments.picture, file, node, alike);
  }
  writeJson(arguments.json, jsonOf(file, node, alike));
  return kExitDone;
}

} // namespace

void addMapNodeCommand(CliCommand map)
{
  auto arguments = std::make_shared<NodeArguments>();
  CliCommand command = map.command("node", "All that it holds about one place");
  command.examples("Example: homeward map node kitchen --map lab.hwm --picture kitchen.png");
  command.option("node", arguments->node, "Node, number or name").required();
  command.option("--map", arguments->map, "Map file").required();
  command.output("--picture", arguments->picture,
                 "Picture of it, .svg or .png (- for standard output)");
  command.json(arguments->json, "the same");
  command.run([arguments] { return show(*arguments); });
}

} // namespace homeward
