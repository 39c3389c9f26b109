// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibrate_options.h"

#include <homeward/camera/camera_models.h>

#include <CLI/CLI.hpp>

namespace homeward
{

void addCalibrateOptions(CLI::App &app, CalibrateOptions &options)
{
  app.add_option("pictures", options.pictures, "Pictures, folders or patterns such as 'a*.png'");
  app.add_option("--film", options.film, "A film instead of pictures");
  app.add_option("--live", options.live,
                 "A camera to watch, /dev/video0 or http://...; says what to do with the board");
  app.add_option("--keep", options.keep, "Folder for the views of a live camera");
  app.add_option("--most", options.most, "Frames taken of a film, views of a live camera")
      ->check(CLI::Range(3, 1000))
      ->capture_default_str();
  addTargetOptions(app, options.target);
  app.add_option("--model", options.model, "Camera model")
      ->check(CLI::IsMember(cameraModelNames()))
      ->capture_default_str();
  app.add_flag("--no-distortion", options.noDistortion, "The lens bends nothing");
  addMountOptions(app, options.mount);
  app.add_option("--threads", options.threads, "Pictures searched at a time; changes no result")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("-o,--output", options.output, "Camera file to write (YAML)")
      ->capture_default_str();
  app.add_option("--report", options.report, "Report to write (HTML, one file)");
  app.add_option("--json", options.json, "Write a summary as JSON (- for standard output)");
}

} // namespace homeward
