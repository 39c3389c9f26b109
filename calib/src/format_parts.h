// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/formats.h>
#include <homeward/camera/camera_models.h>
#include <homeward/core/error.h>

#include <cstdio>
#include <initializer_list>

// One reader and one writer a format; formats.cpp chooses.
namespace homeward
{

using ModelPointer = std::unique_ptr<CameraModel>;

ModelPointer parseVisp(const std::string &text, const std::string &origin,
                       std::optional<PictureSize> size);
ModelPointer parseOpencv(const std::string &text, const std::string &origin,
                         std::optional<PictureSize> size);
ModelPointer parseKalibr(const std::string &text, const std::string &origin);
ModelPointer parseOcamcalib(const std::string &text, const std::string &origin);
ModelPointer parseLibper(const std::string &text, const std::string &origin,
                         std::optional<PictureSize> size);
std::string formatVisp(const CameraModel &model);
std::string formatOpencv(const CameraModel &model);
std::string formatKalibr(const CameraModel &model);
std::string formatOcamcalib(const CameraModel &model);
std::string formatLibper(const CameraModel &model);

/** makeCameraModel() whose refusal names the file. */
inline ModelPointer modelFrom(const std::string &name, const Eigen::VectorXd &parameters,
                              PictureSize size, const std::string &origin)
{
  try {
    return makeCameraModel(name, parameters, size.width, size.height);
  }
  catch (const LogicError &error) {
    throw ConfigError(origin + ": " + error.what());
  }
}

/** The size of the file, else the one given. @throw ConfigError when there is none */
inline PictureSize sizeOr(double width, double height, std::optional<PictureSize> given,
                          const std::string &origin)
{
  if (width >= 1.0 && height >= 1.0 && width < 65536.0 && height < 65536.0) {
    return {static_cast<int>(width), static_cast<int>(height)};
  }
  if (!given) {
    throw ConfigError(origin + ": it does not say how large the picture is; give width and height");
  }
  return *given;
}

/** As many digits as a double has. */
inline std::string digits(double value)
{
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

[[noreturn]] inline void cannotHold(const char *format, const CameraModel &model,
                                    const std::string &what)
{
  throw ConfigError(std::string(format) + " files cannot hold " + what + " of the " + model.name() +
                    " model; convert it to a model that they hold");
}

} // namespace homeward
