// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/calib/calibration.h>
#include <homeward/calib/mirror_circles.h>

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** Everything that a report shows. */
struct ReportContent
{
  std::string target; ///< one line
  BoardViews views;
  Calibration calibration;
  std::vector<cv::Mat> pictures;   ///< one a view
  std::vector<std::string> missed; ///< pictures in which no board was found
  std::optional<MirrorCircles> mirror;
  cv::Mat panorama;        ///< empty: none
  double bendBefore = 0.0; ///< how far the boards' lines bend with a rough camera, rms, degrees
  double bendAfter = 0.0;  ///< the same with the calibrated one
};

/** One HTML file that needs no other. */
std::string reportHtml(const ReportContent &content);

/** How far the straight lines of the boards are from great circles, rms, degrees. */
double bendOfBoards(const BoardViews &views, const CameraModel &model);

} // namespace homeward
