// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 02: pictures of a chessboard tell what the mirror camera is. The pictures are made here,
// by a camera that is known, so that the answer can be compared with it.
#include "../support/board_pictures.h"

#include <homeward/calib/board_detector.h>
#include <homeward/calib/calibration.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdio>

using namespace homeward;

/** All pictures in one, with the corners that were found. */
cv::Mat draw(const std::vector<cv::Mat> &photos, const BoardViews &views)
{
  cv::Mat all = photos[0].clone();
  for (const cv::Mat &photo : photos) {
    photo.copyTo(all, photo != boards::kRoom);
  }
  cv::Mat picture;
  cv::cvtColor(all, picture, cv::COLOR_GRAY2BGR);
  for (const BoardView &view : views.views) {
    for (const Eigen::Vector2d &corner : view.pixels) {
      cv::circle(picture, {cvRound(corner.x()), cvRound(corner.y())}, 2, {0, 140, 255}, cv::FILLED,
                 cv::LINE_AA);
    }
  }
  return picture;
}

int main()
{
  UnifiedCamera::Parameters parameters;
  parameters.xi = 0.95;
  parameters.fx = parameters.fy = 208.0;
  parameters.cx = 486.3;
  parameters.cy = 354.8;
  const UnifiedCamera truth(parameters, 960, 720);
  const Target board{TargetKind::Chessboard, 9, 6, 0.04}; // inner corners and metres

  Random random(/*seed*/ 1, /*stream*/ 0);
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d middle(0.5 * 8 * board.pitch, 0.5 * 5 * board.pitch, 0.0);
    pictures.push_back(
        boards::photograph(truth, drawTarget(board), boards::held(i, middle, random)));
  }

  BoardViews views{truth.width(), truth.height(), {}};
  for (const auto &found : findBoards(pictures, board, std::nullopt, /*threads*/ 2)) {
    if (found) {
      views.views.push_back(*found);
    }
  }
  const Calibration calibration = calibrate(views);

  cv::imwrite("02-calibrate.png", draw(pictures, views));

  std::printf("%zu pictures, %zu boards found\n", pictures.size(), views.views.size());
  const std::vector<std::string> names = calibration.model->parameterNames();
  const Eigen::VectorXd found = calibration.model->parameters();
  const auto value = [&](const std::string &name) {
    return found(std::find(names.begin(), names.end(), name) - names.begin());
  };
  std::printf("       true  found\n");
  std::printf("xi     %4.2f  %5.2f\n", parameters.xi, value("xi"));
  std::printf("fx    %5.0f  %5.0f\n", parameters.fx, value("fx"));
  std::printf("cx    %5.0f  %5.0f\n", parameters.cx, value("cx"));
  std::printf("cy    %5.0f  %5.0f\n", parameters.cy, value("cy"));
  std::printf("corners fit to a tenth of a pixel: %s\n", calibration.rms < 0.1 ? "yes" : "no");
}
