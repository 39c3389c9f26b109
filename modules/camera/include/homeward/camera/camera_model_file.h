// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_model.h>

#include <memory>
#include <string>

namespace homeward
{

/**
 * Reads the model of a camera file, which may be any: `model: NAME`, `image: {width, height}`,
 * `parameters: {...}` by their names. `mirror` and `mount` may stand there and are not read.
 * Distortion parameters that are missing are zero.
 * @param yaml its text
 * @param origin the file's name, for messages
 * @throw ConfigError naming key, value and file
 */
std::unique_ptr<CameraModel> parseCameraModel(const std::string &yaml, const std::string &origin);

/** The text that parseCameraModel() reads back. */
std::string formatCameraModel(const CameraModel &model);

} // namespace homeward
