// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/mirror_circles.h>
#include <homeward/camera/camera_file.h>

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** What is known of the mirror beforehand. What is empty is estimated from the scene's lines. */
struct MirrorSheet
{
  std::optional<double> xi;           ///< 0.7 to 1 for hyperbolic mirrors, 1 for parabolic ones
  std::optional<double> rimElevation; ///< what the rim shows, above the horizon, radians
};

/** A camera without a target. */
struct QuickCalibration
{
  UnifiedCamera camera; ///< with the parameters that a room shows; the others as assumed
  MirrorCircles mirror; ///< where its circles were found
  int lines = 0;        ///< straight edges of the scene that the camera explains
  double bendPx = 0.0;  ///< how far these bend from great circles, rms, pixels
  std::vector<std::string> assumed;  ///< one sentence for each parameter that was not measured
  std::vector<std::string> warnings; ///< one sentence each, what to do
};

/**
 * Calibrates from pictures of a room: the mirror's rim gives the centre; edges that are straight in
 * the scene lie on great circles of the unit sphere, verticals of it on planes through the axis of
 * an upright mirror. \cite Barreto2001 on lines in central mirror pictures.
 * @param pictures CV_8UC1 or CV_8UC3, all of one size
 * @throw ConfigError when no mirror is found or the sheet is impossible
 */
QuickCalibration calibrateFromScene(const std::vector<cv::Mat> &pictures,
                                    const MirrorSheet &sheet = {});

} // namespace homeward
