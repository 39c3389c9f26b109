// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mount_options.h"
#include "pictures.h"

#include <homeward/calib/quick_calibration.h>
#include <homeward/camera/unwarper.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <chrono>
#include <cmath>
#include <memory>

namespace homeward
{
namespace
{

struct QuickOptions
{
  std::vector<std::string> pictures;
  std::string output = "camera.yaml";
  std::string panorama;
  MountOptions mount;
  double xi = std::nan("");
  double rimDegrees = std::nan("");
  std::string json;
};

std::optional<double> given(double value)
{
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

nlohmann::json summaryOf(const QuickCalibration &quick, std::size_t pictures)
{
  nlohmann::json json = jsonHeader("quick");
  const UnifiedCamera::Parameters &p = quick.camera.parameters();
  json["model"] = "unified";
  const std::pair<const char *, double> values[] = {
      {"xi", p.xi}, {"fx", p.fx}, {"fy", p.fy}, {"cx", p.cx}, {"cy", p.cy}};
  for (const auto &[name, value] : values) {
    json["parameters"][name] = {{"value", value}, {"sigma", nullptr}};
  }
  json["views"] = pictures;
  json["lines"] = quick.lines;
  json["line_bend_px"] = quick.bendPx;
  json["assumed"] = quick.assumed;
  json["warnings"] = quick.warnings;
  json["seed"] = 0;
  return json;
}

void calibrateQuickly(const QuickOptions &options)
{
  const auto begin = std::chrono::steady_clock::now();
  const Pictures pictures = readPictures(options.pictures);
  MirrorSheet sheet{given(options.xi), given(options.rimDegrees)};
  if (sheet.rimElevation) {
    sheet.rimElevation = radians(*sheet.rimElevation);
  }
  const QuickCalibration quick = calibrateFromScene(pictures.images, sheet);
  const MirrorCamera camera{quick.camera, ringOf(quick.mirror, quick.camera), options.mount.mount(),
                            rimOf(quick.mirror)};
  if (!options.panorama.empty()) {
    const Unwarper unwarper(camera, wholePanorama(camera));
    writeText(options.panorama,
              encodePicture(options.panorama, unwarper.unwarp(pictures.images.front()).image));
  }
  writeText(options.output, formatMirrorCamera(camera));
  nlohmann::json json = summaryOf(quick, pictures.images.size());
  json["camera"] = options.output;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = spent.count();
  writeJson(options.json, json);
  std::printf("%d straight edges, bent by %.2f px rms; wrote %s\n", quick.lines, quick.bendPx,
              options.output.c_str());
  for (const std::string &assumed : quick.assumed) {
    std::printf("assumed: %s\n", assumed.c_str());
  }
  for (const std::string &warning : quick.warnings) {
    std::fprintf(stderr, "homeward-calibrate: %s\n", warning.c_str());
  }
}

} // namespace

void addQuickCommand(CliCommand app)
{
  auto options = std::make_shared<QuickOptions>();
  CliCommand command = app.command("quick", "Calibrate without a target, from pictures of a room");
  command.examples("Example: homeward-calibrate quick room.jpg -o camera.yaml --panorama room.png");
  command.option("pictures", options->pictures, "Pictures, folders or patterns").required();
  command.output("-o,--output", options->output, "Camera file to write (YAML)").showDefault();
  command.option("--panorama", options->panorama, "Unwrapped first picture to write");
  command.option("--xi", options->xi, "xi of the mirror, from its data sheet").between(0.3, 3.0);
  command
      .option("--rim-elevation", options->rimDegrees,
              "What the rim shows above the horizon, degrees, from its data sheet")
      .between(-60.0, 60.0);
  addMountOptions(command, options->mount);
  command.json(options->json, "a summary");
  command.run([options] {
    calibrateQuickly(*options);
    return kExitDone;
  });
}

} // namespace homeward
