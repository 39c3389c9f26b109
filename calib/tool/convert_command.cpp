// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"

#include <homeward/calib/convert.h>
#include <homeward/calib/formats.h>
#include <homeward/camera/camera_models.h>
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
  std::string model; ///< empty: as it is
  int width = 0;     ///< pixels
  int height = 0;    ///< pixels
  std::string json;
};

std::unique_ptr<CameraModel> read(const ConvertOptions &options)
{
  const std::string text = readText(options.input, "camera file");
  const CameraFormat format =
      options.from.empty() ? guessCameraFormat(text, options.input) : cameraFormat(options.from);
  const std::optional<PictureSize> size =
      options.width > 0 ? std::optional(PictureSize{options.width, options.height}) : std::nullopt;
  return parseCamera(text, format, options.input, size);
}

void convert(const ConvertOptions &options)
{
  std::shared_ptr<const CameraModel> model = read(options);
  nlohmann::json json = jsonHeader("convert");
  json["from"] = model->name();
  ModelFit fit{model, 0.0, 0.0, 0.0};
  if (!options.model.empty() && options.model != model->name()) {
    fit = fitModel(*model, options.model, pixelGrid(*model));
  }
  writeText(options.output, formatCamera(*fit.model, cameraFormat(options.to)));
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
  command.json(options->json, "a summary");
  command.run([options] {
    convert(*options);
    return kExitDone;
  });
}

} // namespace homeward
