// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_model.h>

namespace homeward
{

/** Every CameraModel::name() there is. */
std::vector<std::string> cameraModelNames();

/**
 * The model of a name.
 * @param parameters in the model's order
 * @throw LogicError for another name and for parameters that are none of this model
 */
std::unique_ptr<CameraModel>
makeCameraModel(const std::string &name, const Eigen::VectorXd &parameters, int width, int height);

} // namespace homeward
