// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>

#include <opencv2/ccalib/omnidir.hpp>

#include <cmath>
#include <vector>

namespace homeward
{

/** What stock OpenCV makes of views. */
struct StockCalibration
{
  double xi = 0.0;
  cv::Matx33d K;
  std::vector<double> D;
  double rms = 0.0; ///< over the points of all views, computed here, pixels
  int views = 0;    ///< that it used
};

/** cv::omnidir::calibrate as its documentation calls it. */
inline StockCalibration calibrateWithOpencv(const BoardViews &views)
{
  std::vector<cv::Mat> board;
  std::vector<cv::Mat> pixels;
  for (const BoardView &view : views.views) {
    cv::Mat points(1, static_cast<int>(view.board.size()), CV_64FC3);
    cv::Mat seen(1, points.cols, CV_64FC2);
    for (int i = 0; i < points.cols; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::Vector3d &b = view.board[at];
      points.at<cv::Vec3d>(i) = {b.x(), b.y(), b.z()};
      seen.at<cv::Vec2d>(i) = {view.pixels[at].x(), view.pixels[at].y()};
    }
    board.push_back(points);
    pixels.push_back(seen);
  }
  cv::Mat K;
  cv::Mat xi;
  cv::Mat D;
  cv::Mat used;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::omnidir::calibrate(board, pixels, {views.width, views.height}, K, xi, D, rotations,
                         translations, 0,
                         {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-8}, used);
  StockCalibration result;
  result.xi = xi.at<double>(0);
  result.K = K;
  D.reshape(1, 1).copyTo(result.D);
  result.views = static_cast<int>(used.total());
  double sum = 0.0;
  int points = 0;
  for (int i = 0; i < result.views; ++i) {
    const auto v = static_cast<std::size_t>(used.at<int>(i));
    const auto at = static_cast<std::size_t>(i);
    cv::Mat predicted;
    cv::omnidir::projectPoints(board[v], predicted, rotations[at], translations[at], K, result.xi,
                               D);
    sum += std::pow(cv::norm(predicted.reshape(2, 1), pixels[v].reshape(2, 1)), 2.0);
    points += board[v].cols;
  }
  result.rms = std::sqrt(sum / points);
  return result;
}

} // namespace homeward
