// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/scale_space_homing.h>

#include <opencv2/core/types.hpp>

#include <vector>

namespace homeward
{

/**
 * Features of the current view (queryIdx) with those most like them in the snapshot (trainIdx).
 * Upright features are compared with those that stand where a landmark can have come to on a level
 * floor, features of SIFT with all.
 * @param matchRatio best over second best distance; matches with as much are left out
 */
std::vector<cv::DMatch> matchKeypoints(const ScaleSpaceView &current,
                                       const ScaleSpaceView &snapshot, double matchRatio);

} // namespace homeward
