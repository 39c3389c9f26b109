// SPDX-License-Identifier: GPL-3.0-or-later
#include "drive_map.h"

#include "command_line.h"
#include "files.h"
#include "mission_setup.h"
#include "recording.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#ifdef HOMEWARD_BAGS
#include <homeward/bag/bag_reader.h>
#include <homeward/bag/tick_recorder.h>
#include <homeward/run/drive_mapper.h>

#include <array>
#include <cstdio>
#endif

namespace homeward
{

#ifdef HOMEWARD_BAGS

namespace
{

BagTopics topicsOf(const DriveMapArguments &arguments)
{
  BagTopics topics;
  const auto set = [](std::string &topic, const std::string &wanted) {
    topic = wanted.empty() ? topic : wanted;
  };
  set(topics.image, arguments.imageTopic);
  set(topics.scan, arguments.scanTopic);
  set(topics.odometry, arguments.odometryTopic);
  return topics;
}

/** What came out of bags for a map. */
struct Heard
{
  int odometry = 0;
  int scans = 0;
  int pictures = 0;

  void operator()(const BaseState & /*state*/) { ++odometry; }
  void operator()(const Scan & /*scan*/) { ++scans; }
  void operator()(const Frame & /*frame*/) { ++pictures; }
};

/** Gives every reading of the bags to the mapper. */
Heard drive(const DriveMapArguments &arguments, DriveMapper &mapper)
{
  Heard heard;
  for (const std::filesystem::path &part : bagParts(arguments.bag)) {
    BagReader reader(part, topicsOf(arguments));
    while (const std::optional<BagMessage> message = reader.next()) {
      std::visit(
          [&](const auto &what) {
            if constexpr (requires { mapper.take(what); }) {
              mapper.take(what);
              heard(what);
            }
          },
          message->what);
    }
  }
  return heard;
}

/** @throw ConfigError naming what a map cannot be made without */
void expectAll(const Heard &heard, const std::string &bag)
{
  const std::array<std::pair<int, const char *>, 3> all{
      {{heard.pictures, "pictures (sensor_msgs/Image or CompressedImage, --image-topic)"},
       {heard.scans, "scans (sensor_msgs/LaserScan, --scan-topic)"},
       {heard.odometry, "odometry (nav_msgs/Odometry, --odometry-topic)"}}};
  for (const auto &[count, what] : all) {
    if (count == 0) {
      throw ConfigError("the bag " + bag + " has no " + what);
    }
  }
}

} // namespace

int makeDriveMap(const DriveMapArguments &arguments)
{
  if (bagParts(arguments.bag).empty()) {
    throw StoreError("the bag " + arguments.bag + " does not exist");
  }
  const std::optional<RobotFiles> recorded =
      arguments.rig.empty() ? recordedFiles(arguments.bag) : std::nullopt;
  const RobotFiles files = recorded ? *recorded : loadRobotFiles(arguments.rig);
  const PilotOptions pilot = pilotOptions(files.rig, false, "minwarping");
  DriveMapperOptions options;
  options.forwardDistance = arguments.forwardDistance;
  options.places = pilot.places;
  options.panorama = pilot.panorama;
  options.directions = openDirectionOptions(arguments.forwardDistance);
  MapFile file =
      MapFile::create(arguments.map, mapHeader(files, pilot),
                      arguments.overwrite ? MapFile::IfExists::Replace : MapFile::IfExists::Refuse);
  DriveMapper mapper(files.camera, files.robot.rMl, file, options);
  expectAll(drive(arguments, mapper), arguments.bag);
  mapper.finish();
  const TopologicalMap map = file.map();
  file.close();
  std::printf("nodes %zu, edges %zu, known places come to again %d, distance %.1f m\n",
              map.nodes().size(), map.edges().size(), mapper.recognitions(), mapper.travelled());
  nlohmann::json json = jsonHeader("replay");
  json["nodes"] = map.nodes().size();
  json["edges"] = map.edges().size();
  json["recognitions"] = mapper.recognitions();
  json["distance_m"] = mapper.travelled();
  writeJson(arguments.json, json);
  return kExitDone;
}

#else

int makeDriveMap(const DriveMapArguments & /*arguments*/)
{
  refuseBags();
}

#endif

} // namespace homeward
