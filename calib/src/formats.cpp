// SPDX-License-Identifier: GPL-3.0-or-later
#include "format_parts.h"

#include <homeward/camera/camera_model_file.h>

namespace homeward
{
namespace
{

struct FormatName
{
  CameraFormat format;
  const char *name;
};

constexpr FormatName kFormats[] = {
    {CameraFormat::Homeward, "homeward"},   {CameraFormat::Visp, "visp"},
    {CameraFormat::Opencv, "opencv"},       {CameraFormat::Kalibr, "kalibr"},
    {CameraFormat::Ocamcalib, "ocamcalib"}, {CameraFormat::Libper, "libper"}};

} // namespace

std::vector<std::string> cameraFormatNames()
{
  std::vector<std::string> names;
  for (const FormatName &format : kFormats) {
    names.emplace_back(format.name);
  }
  return names;
}

CameraFormat cameraFormat(const std::string &name)
{
  std::string names;
  for (const FormatName &format : kFormats) {
    if (name == format.name) {
      return format.format;
    }
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  throw ConfigError("no camera format is called '" + name + "'; there are " + names);
}

CameraFormat guessCameraFormat(const std::string &text, const std::string &origin)
{
  const auto has = [&](const char *word) { return text.find(word) != std::string::npos; };
  if (has("<camera>")) {
    return has("<au>") ? CameraFormat::Libper : CameraFormat::Visp;
  }
  if (has("%YAML:1.0") || has("opencv-matrix") || has("<opencv_storage>")) {
    return CameraFormat::Opencv;
  }
  if (has("cam0:")) {
    return CameraFormat::Kalibr;
  }
  if (has("ocam_model") || has("affine parameters")) {
    return CameraFormat::Ocamcalib;
  }
  if (has("model:")) {
    return CameraFormat::Homeward;
  }
  throw ConfigError(origin +
                    " looks like no camera file that is read here (homeward, visp, opencv, "
                    "kalibr, ocamcalib, libper)");
}

ModelPointer parseCamera(const std::string &text, CameraFormat format, const std::string &origin,
                         std::optional<PictureSize> size)
{
  switch (format) {
  case CameraFormat::Homeward:
    return parseCameraModel(text, origin);
  case CameraFormat::Visp:
    return parseVisp(text, origin, size);
  case CameraFormat::Opencv:
    return parseOpencv(text, origin, size);
  case CameraFormat::Kalibr:
    return parseKalibr(text, origin);
  case CameraFormat::Ocamcalib:
    return parseOcamcalib(text, origin);
  case CameraFormat::Libper:
    return parseLibper(text, origin, size);
  }
  throw LogicError("no such camera format");
}

std::string formatCamera(const CameraModel &model, CameraFormat format)
{
  switch (format) {
  case CameraFormat::Homeward:
    return formatCameraModel(model);
  case CameraFormat::Visp:
    return formatVisp(model);
  case CameraFormat::Opencv:
    return formatOpencv(model);
  case CameraFormat::Kalibr:
    return formatKalibr(model);
  case CameraFormat::Ocamcalib:
    return formatOcamcalib(model);
  case CameraFormat::Libper:
    return formatLibper(model);
  }
  throw LogicError("no such camera format");
}

} // namespace homeward
