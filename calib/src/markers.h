// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/target.h>

#include <opencv2/aruco.hpp>

namespace homeward
{

/** The markers that a kind of target bears. */
inline cv::Ptr<cv::aruco::Dictionary> dictionaryOf(TargetKind kind)
{
  return cv::aruco::getPredefinedDictionary(
      kind == TargetKind::AprilGrid ? cv::aruco::DICT_APRILTAG_36h11 : cv::aruco::DICT_5X5_1000);
}

} // namespace homeward
