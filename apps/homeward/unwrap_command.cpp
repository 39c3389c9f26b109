// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"

#include <homeward/camera/rim.h>
#include <homeward/camera/unwarper.h>
#include <homeward/core/error.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <chrono>
#include <memory>

namespace homeward
{
namespace
{

struct UnwrapOptions
{
  std::string picture;
  std::string camera;
  std::string output = "panorama.png";
  int width = 720;
  int height = 160;
  std::vector<double> elevations{-45.0, 35.0};
  bool gray = false;
  std::string json;
};

PanoramaGeometry geometryOf(const UnwrapOptions &options)
{
  PanoramaGeometry geometry;
  geometry.width = options.width;
  geometry.height = options.height;
  geometry.elevationMin = radians(options.elevations[0]);
  geometry.elevationMax = radians(options.elevations[1]);
  if (geometry.elevationMin >= geometry.elevationMax) {
    throw ConfigError("--elevations " + std::to_string(options.elevations[0]) + " " +
                      std::to_string(options.elevations[1]) + ": the first must be the smaller");
  }
  return geometry;
}

void unwrap(const UnwrapOptions &options)
{
  const MirrorCamera camera =
      parseMirrorCamera(readText(options.camera, "camera file"), options.camera);
  const cv::Mat picture =
      cv::imread(options.picture, options.gray ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
  if (picture.empty()) {
    throw ConfigError("cannot read the picture " + options.picture +
                      "; is it a PNG, JPEG or other image file?");
  }
  if (picture.cols != camera.model.width() || picture.rows != camera.model.height()) {
    throw ConfigError(options.picture + " has " + std::to_string(picture.cols) + " x " +
                      std::to_string(picture.rows) + " pixels, the camera file " + options.camera +
                      " says " + std::to_string(camera.model.width()) + " x " +
                      std::to_string(camera.model.height()));
  }
  const auto shift = rimShift(picture, camera);
  const Unwarper unwarper(shift ? followRim(camera, {*shift}) : camera, geometryOf(options));
  const auto begin = std::chrono::steady_clock::now();
  const Panorama panorama = unwarper.unwarp(picture);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  writeText(options.output, encodePicture(options.output, panorama.image));
  nlohmann::json json = jsonHeader("unwrap");
  json["wall_time_s"] = spent.count();
  json["picture"] = options.picture;
  json["panorama"] = options.output;
  writeJson(options.json, json);
}

} // namespace

void addUnwrapCommand(CliCommand app)
{
  auto options = std::make_shared<UnwrapOptions>();
  CliCommand command = app.command("unwrap", "Turn a mirror picture into a panorama");
  command.examples("Example: homeward unwrap picture.jpg --camera camera.yaml -o panorama.png");
  command.option("picture", options->picture, "Mirror picture").required();
  command.option("--camera", options->camera, "Camera file (YAML)").required();
  command.option("-o,--output", options->output, "Panorama to write").showDefault();
  command.option("--width", options->width, "Columns round the full turn")
      .between(8, 16384)
      .showDefault();
  command.option("--height", options->height, "Rows").between(2, 8192).showDefault();
  command.option("--elevations", options->elevations, "Lowest and highest elevation, degrees")
      .count(2, 2)
      .between(-89.9, 89.9)
      .showDefault();
  command.flag("--gray", options->gray, "Gray instead of colour");
  command.json(options->json, "a summary");
  command.run([options] {
    unwrap(*options);
    return kExitDone;
  });
}

} // namespace homeward
