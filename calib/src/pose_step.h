// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

namespace homeward
{

using CameraTwist = Eigen::Matrix<double, 6, 1>; ///< (v, w) of the camera in its own frame

/** cMo after the camera has moved with a twist for a second, as in virtual visual servoing. */
Eigen::Isometry3d moved(const Eigen::Isometry3d &cMo, const CameraTwist &twist);

} // namespace homeward
