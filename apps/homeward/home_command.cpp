// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"

#include <homeward/core/error.h>
#include <homeward/dataset/data_set.h>
#include <homeward/homing/homing_method.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

struct HomeArguments
{
  std::string current;
  std::string snapshot;
  std::string camera;
  std::string panorama;
  std::string method = "minwarping";
  std::string json;
};

/** How the two pictures become panoramas, as a data set without views. */
DataSet layoutOf(const HomeArguments &arguments, const cv::Mat &first)
{
  if (!arguments.camera.empty()) {
    return DataSet(parseMirrorCamera(readText(arguments.camera, "camera file"), arguments.camera));
  }
  const std::string text = readText(arguments.panorama, "panorama file");
  return {parsePanoramaLayout(text, arguments.panorama), first.size()};
}

void home(const HomeArguments &arguments)
{
  const auto begin = std::chrono::steady_clock::now();
  const cv::Mat current = readPicture(arguments.current);
  const cv::Mat snapshot = readPicture(arguments.snapshot);
  DataSet layout = layoutOf(arguments, current);
  layout.followRim({current, snapshot});
  const std::unique_ptr<HomingMethod> method = makeHomingMethod(arguments.method);
  const std::optional<HomeVector> found =
      method->compute(layout.panoramaOf(current, arguments.current),
                      layout.panoramaOf(snapshot, arguments.snapshot));
  if (!found) {
    throw RuntimeError("the pictures tell no way home: are they dark, blank or of other places?");
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  nlohmann::json json = jsonHeader("home");
  json["wall_time_s"] = wall.count();
  json["method"] = arguments.method;
  json["direction_rad"] = found->direction;
  json["distance_proxy"] = found->distanceProxy;
  json["heading_change_rad"] = found->headingChange;
  json["confidence"] = found->confidence;
  writeJson(arguments.json, json);
  std::printf("direction %.1f deg (left is positive), distance proxy %.2f, heading change %.1f "
              "deg, confidence %.2f\n",
              degrees(found->direction), found->distanceProxy, degrees(found->headingChange),
              found->confidence);
}

} // namespace

void addHomeCommand(CliCommand app)
{
  auto arguments = std::make_shared<HomeArguments>();
  CliCommand command = app.command("home", "Way home from two pictures");
  command.examples("Example: homeward home --current now.jpg --snapshot home.jpg "
                   "--camera camera.yaml --json -");
  command.option("--current", arguments->current, "Picture taken where the robot is").required();
  command.option("--snapshot", arguments->snapshot, "Picture taken at home").required();
  CliCommand layout = command.exactlyOneOf("layout", "What the pictures are");
  layout.option("--camera", arguments->camera, "Mirror pictures: camera file (YAML)");
  layout.option("--panorama", arguments->panorama, "Panoramas: layout file (panorama.yaml)");
  command.option("--method", arguments->method, "How home is found")
      .oneOf(homingMethodNames())
      .showDefault();
  command.json(arguments->json, "the answer");
  command.run([arguments] {
    home(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
