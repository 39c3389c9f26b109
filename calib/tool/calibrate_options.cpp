// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibrate_options.h"

#include <homeward/camera/camera_models.h>

namespace homeward
{

void addCalibrateOptions(CliCommand app, CalibrateOptions &options)
{
  app.option("pictures", options.pictures, "Pictures, folders or patterns such as 'a*.png'");
  app.option("--film", options.film, "A film instead of pictures");
  app.option("--live", options.live,
             "A camera to watch, /dev/video0 or http://...; says what to do with the board");
  app.option("--keep", options.keep, "Folder for the views of a live camera");
  app.option("--most", options.most, "Frames taken of a film, views of a live camera")
      .between(3, 1000)
      .showDefault();
  addTargetOptions(app, options.target);
  app.option("--model", options.model, "Camera model").oneOf(cameraModelNames()).showDefault();
  app.flag("--no-distortion", options.noDistortion, "The lens bends nothing");
  addMountOptions(app, options.mount);
  app.option("--threads", options.threads, "Pictures searched at a time; changes no result")
      .between(1, 64)
      .showDefault();
  app.output("-o,--output", options.output, "Camera file to write (YAML)").showDefault();
  app.output("--report", options.report, "Report to write (HTML, one file)");
  app.json(options.json, "a summary");
}

} // namespace homeward
