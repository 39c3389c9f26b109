// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/truth_log.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/simulator.h>
#include <homeward/store/export.h>
#include <homeward/store/map_check.h>
#include <homeward/store/map_file.h>
#include <homeward/viewer/map_picture.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

namespace fs = std::filesystem;

struct MapArguments
{
  std::vector<std::string> maps;
  std::string map;
  std::string output;
  std::string format;
  std::string world;
  std::string json;
  int width = 1200;
};

void info(const MapArguments &arguments)
{
  const MapFile file = MapFile::open(arguments.map, MapFile::Access::Read);
  const TopologicalMap &map = file.map();
  std::printf("%s: nodes %zu, edges %zu, open directions %d, %ju bytes\n", arguments.map.c_str(),
              map.nodes().size(), map.edges().size(), map.openDirectionCount(),
              static_cast<std::uintmax_t>(fs::file_size(arguments.map)));
  for (const auto &[id, node] : map.nodes()) {
    std::printf("node %lld%s%s: ", static_cast<long long>(id.value), node.name.empty() ? "" : " ",
                node.name.c_str());
    for (const NodeId neighbour : map.neighbours(id)) {
      std::printf("- %lld ", static_cast<long long>(neighbour.value));
    }
    std::printf("\n");
    for (const Direction &direction : node.directions) {
      std::printf("  %+4.0f deg %s %s\n", degrees(direction.bearing),
                  std::string(name(direction.state)).c_str(), direction.reason.c_str());
    }
  }
  nlohmann::json json = jsonHeader("map info");
  json["nodes"] = map.nodes().size();
  json["edges"] = map.edges().size();
  json["open_directions"] = map.openDirectionCount();
  writeJson(arguments.json, json);
}

int check(const std::vector<std::string> &maps)
{
  bool sound = true;
  for (const std::string &map : maps) {
    const MapCheck check = checkMap(map);
    for (const std::string &finding : check.findings) {
      std::fprintf(stderr, "homeward: %s\n", finding.c_str());
    }
    if (check.findings.empty()) {
      std::printf("%s: ok, nodes %zu, edges %zu, pictures %zu\n", map.c_str(), check.nodes,
                  check.edges, check.pictures);
    }
    sound = sound && check.findings.empty();
  }
  return sound ? kExitDone : kExitFailed;
}

/** The floor of the world that the map was made in, when the truth beside the map names it. */
std::optional<FloorPicture> floorOf(const TruthLog &truth)
{
  const auto scene = std::make_shared<const Scene>(loadScene(truth.world));
  const RobotDescription robot =
      parseRobotDescription(readText(truth.robot, "robot description"), truth.robot);
  const std::string cameraFile = shippedFile("cameras/sim_nominal.yaml").string();
  const MirrorCamera camera = parseMirrorCamera(readText(cameraFile, "camera file"), cameraFile);
  SimulatorOptions options;
  options.start = truth.start;
  const Simulator simulator(scene, robot, camera, options);
  const FloorPlan plan = simulator.freeSpace().floorPlan();
  return FloorPicture{plan.image, plan.origin, plan.resolution};
}

void render(const MapArguments &arguments)
{
  const MapFile file = MapFile::open(arguments.map, MapFile::Access::Read);
  std::optional<TruthLog> truth = loadTruthLog(truthLogFile(arguments.map));
  MapPicture picture;
  picture.width = arguments.width;
  picture.title = fs::path(arguments.map).stem().string();
  const bool known =
      truth && std::all_of(file.map().nodes().begin(), file.map().nodes().end(),
                           [&](const auto &node) { return truth->nodes.contains(node.first); });
  if (truth && !known) {
    std::fprintf(stderr, "homeward: %s lacks nodes of this map; drawn without it\n",
                 truthLogFile(arguments.map).c_str());
  }
  if (known) {
    if (!arguments.world.empty()) {
      truth->world = arguments.world;
    }
    picture.poses = truth->nodes;
    picture.trajectory = truth->path;
    picture.robot = truth->end;
    picture.floor = floorOf(*truth);
  }
  const std::string output = arguments.output.empty()
                                 ? fs::path(arguments.map).replace_extension(".svg").string()
                                 : arguments.output;
  if (fs::path(output).extension() == ".svg") {
    writeText(output, mapSvg(file.map(), picture));
    return;
  }
  writeText(output, encodePicture(output, mapImage(file.map(), picture)));
}

void exportMap(const MapArguments &arguments)
{
  const MapFile file = MapFile::open(arguments.map, MapFile::Access::Read);
  std::string text;
  if (arguments.format == "canonical") {
    text = exportCanonical(file);
  }
  else if (arguments.format == "graphml") {
    text = exportGraphml(file.map());
  }
  else if (arguments.format == "dot") {
    text = exportDot(file.map());
  }
  else {
    text = exportJson(file);
  }
  writeText(arguments.output.empty() ? "-" : arguments.output, text);
}

} // namespace

void addMapCommand(CliCommand app)
{
  auto arguments = std::make_shared<MapArguments>();
  CliCommand map = app.command("map", "Look at a map file, change it");
  map.requireCommand();

  CliCommand infoCommand = map.command("info", "What is in it");
  infoCommand.examples("Example: homeward map info lab.hwm");
  infoCommand.option("map", arguments->map, "Map file").required();
  infoCommand.json(arguments->json, "a summary");
  infoCommand.run([arguments] {
    info(*arguments);
    return kExitDone;
  });

  CliCommand renderCommand = map.command("render", "Draw it, over the true floor plan if known");
  renderCommand.examples("Example: homeward map render lab.hwm -o lab.png");
  renderCommand.option("map", arguments->map, "Map file").required();
  renderCommand.option("-o,--output", arguments->output, "Picture, .svg or .png");
  renderCommand.option("--width", arguments->width, "Of the picture, pixels")
      .between(200, 10000)
      .showDefault();
  renderCommand.option("--world", arguments->world, "World file, where it has moved");
  renderCommand.run([arguments] {
    render(*arguments);
    return kExitDone;
  });

  CliCommand exportCommand = map.command("export", "Write it in another form");
  exportCommand.examples("Example: homeward map export lab.hwm --canonical");
  exportCommand.option("map", arguments->map, "Map file").required();
  exportCommand.option("--format", arguments->format, "canonical, graphml, dot or json")
      .oneOf({"canonical", "graphml", "dot", "json"});
  exportCommand.flag(
      "--canonical", [arguments] { arguments->format = "canonical"; },
      "Short for --format canonical");
  exportCommand.output("-o,--output", arguments->output, "File (default: standard output)");
  exportCommand.run([arguments] {
    exportMap(*arguments);
    return kExitDone;
  });

  CliCommand checkCommand = map.command("check", "Look for damage in files, pictures and graph");
  checkCommand.examples("Example: homeward map check lab.hwm house.hwm");
  checkCommand.option("maps", arguments->maps, "Map files").required();
  checkCommand.run([arguments] { return check(arguments->maps); });

  addMapNodeCommand(map);
  addMapEditCommand(map);
  addMapMergeCommand(map);
  addMapServeCommand(map);
}

} // namespace homeward
