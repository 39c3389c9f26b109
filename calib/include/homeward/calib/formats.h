// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_model.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** Files in which programs keep cameras. */
enum class CameraFormat
{
  Homeward, ///< our YAML, every model
  Visp,     ///< vpXmlParserCamera's XML: pinhole, Kannala-Brandt; in its style, every model
  Opencv, ///< what cv::omnidir's users write: camera_matrix, distortion_coefficients, xi; or K, D,
          ///< xi
  Kalibr, ///< camchain YAML, cam0: omni and pinhole with radtan, eucm, ds, pinhole-equidistant
  Ocamcalib, ///< calib_results.txt: ocam; rows before columns
  Libper     ///< libPeR's XML: unified without distortion; it holds no picture size
};

/** homeward, visp, opencv, kalibr, ocamcalib, libper. */
std::vector<std::string> cameraFormatNames();

/** @throw ConfigError for a name that is none of cameraFormatNames() */
CameraFormat cameraFormat(const std::string &name);

/** What a text looks like. @throw ConfigError when it looks like none of the formats */
CameraFormat guessCameraFormat(const std::string &text, const std::string &origin);

/** Pixels. */
struct PictureSize
{
  int width = 0;  ///< pixels
  int height = 0; ///< pixels
};

/**
 * The camera of a text.
 * @param origin the file's name, for messages
 * @param size of the picture, for formats and files that do not hold it
 * @throw ConfigError with what is wrong, where, and what to do
 */
std::unique_ptr<CameraModel> parseCamera(const std::string &text, CameraFormat format,
                                         const std::string &origin,
                                         std::optional<PictureSize> size = std::nullopt);

/** @throw ConfigError when the format cannot hold the model; it says which conversion helps */
std::string formatCamera(const CameraModel &model, CameraFormat format);

} // namespace homeward
