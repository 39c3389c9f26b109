// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mount_options.h"
#include "pictures.h"

#include <homeward/calib/convert.h>
#include <homeward/calib/formats.h>
#include <homeward/camera/camera_models.h>
#include <homeward/camera/unified_model.h>
#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <memory>

namespace homeward
{
namespace
{

struct ConvertOptions
{
  std::string input;
  std::string output;
  std::string from; ///< empty: by what the file looks like
  std::string to = "homeward";
  std::string model;   ///< empty: as it is
  int width = 0;       ///< pixels
  int height = 0;      ///< pixels
  std::string picture; ///< of the camera, for its mirror
  MountOptions mount;
  std::string json;
};

/** A camera file of any format. */
struct Source
{
  std::string text;
  CameraFormat format;
};

Source sourceOf(const ConvertOptions &options)
{
  std::string text = readText(options.input, "camera file");
  const CameraFormat format =
      options.from.empty() ? guessCameraFormat(text, options.input) : cameraFormat(options.from);
  return {std::move(text), format};
}

std::unique_ptr<CameraModel> read(const ConvertOptions &options, const Source &source)
{
  const std::optional<PictureSize> size =
      options.width > 0 ? std::optional(PictureSize{options.width, options.height}) : std::nullopt;
  return parseCamera(source.text, source.format, options.input, size);
}

/** Ring, rim and mount from a picture of the camera. */
MirrorCamera seenIn(const ConvertOptions &options, const UnifiedCamera &camera)
{
  const cv::Mat picture = grayOf(readPicture(options.picture));
  if (picture.cols != camera.width() || picture.rows != camera.height()) {
    throw ConfigError(options.picture + " has " + std::to_string(picture.cols) + " x " +
                      std::to_string(picture.rows) + " pixels, the camera " +
                      std::to_string(camera.width()) + " x " + std::to_string(camera.height()));
  }
  const auto mirror = findMirror(picture);
  if (!mirror) {
    throw ConfigError("no mirror is seen in " + options.picture +
                      "; its rim must show against the dark round it");
  }
  return {camera, ringOf(*mirror, camera), options.mount.mount(), rimOf(*mirror)};
}

bool hasMirror(const std::string &yaml)
{
  return yaml.find("\nmirror:") != std::string::npos;
}

/** The file's text; of a mirror on a robot, with all that a robot needs where it is known. */
std::string written(const ConvertOptions &options, const Source &source, const CameraModel &model)
{
  const CameraFormat to = cameraFormat(options.to);
  const auto *unified = dynamic_cast<const UnifiedModel *>(&model);
  if (to != CameraFormat::Homeward || unified == nullptr) {
    if (!options.picture.empty()) {
      throw ConfigError("--picture is for the format homeward and the unified model only");
    }
    return formatCamera(model, to);
  }
  if (!options.picture.empty()) {
    return formatMirrorCamera(seenIn(options, unified->camera()));
  }
  if (source.format == CameraFormat::Homeward && hasMirror(source.text)) {
    MirrorCamera camera = parseMirrorCamera(source.text, options.input);
    camera.model = unified->camera();
    return formatMirrorCamera(camera);
  }
  std::fprintf(stderr,
               "homeward-calibrate: %s has no mirror's rim, which homeward needs to unwrap; "
               "--picture FILE, taken by the camera, adds it\n",
               options.output.c_str());
  return formatCamera(model, to);
}

void convert(const ConvertOptions &options)
{
  const Source source = sourceOf(options);
  const std::shared_ptr<const CameraModel> model = read(options, source);
  nlohmann::json json = jsonHeader("convert");
  json["from"] = model->name();
  ModelFit fit{model, 0.0, 0.0, 0.0};
  if (!options.model.empty() && options.model != model->name()) {
    fit = fitModel(*model, options.model, pixelGrid(*model));
  }
  writeText(options.output, written(options, source, *fit.model));
  json["model"] = fit.model->name();
  json["mean_px"] = fit.mean;
  json["largest_px"] = fit.largest;
  json["unseen_share"] = fit.unseen;
  writeJson(options.json, json);
  std::printf("%s as %s: off by %.4f px in the mean, %.4f px at most; wrote %s\n",
              model->name().c_str(), fit.model->name().c_str(), fit.mean, fit.largest,
              options.output.c_str());
  if (fit.unseen > 0.0) {
    std::fprintf(stderr, "homeward-calibrate: %.1f %% of the rays are not seen by the new model\n",
                 100.0 * fit.unseen);
  }
}

} // namespace

void addConvertCommand(CliCommand app)
{
  auto options = std::make_shared<ConvertOptions>();
  CliCommand command =
      app.command("convert", "Convert a camera file to another format or camera model");
  command.examples("Example: homeward-calibrate convert camera.yaml calib_results.txt --to "
                   "ocamcalib --model ocam");
  command.option("input", options->input, "Camera file to read").required();
  command.output("output", options->output, "Camera file to write (- for standard output)")
      .required();
  command.option("--from", options->from, "Format to read (what the file looks like)")
      .oneOf(cameraFormatNames());
  command.option("--to", options->to, "Format to write").oneOf(cameraFormatNames()).showDefault();
  command.option("--model", options->model, "Camera model to write (as it is)")
      .oneOf(cameraModelNames());
  CliOption width = command.option("--width", options->width, "Picture's, where no file holds it")
                        .between(1, 100000);
  command.option("--height", options->height, "Likewise").between(1, 100000).needs("--width");
  width.needs("--height");
  command.option("--picture", options->picture,
                 "A picture that the camera took: adds the mirror's rim, which homeward needs");
  addMountOptions(command, options->mount);
  command.json(options->json, "a summary");
  command.run([options] {
    convert(*options);
    return kExitDone;
  });
}

} // namespace homeward
