// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/target.h>

#include <Eigen/Core>
#include <opencv2/aruco.hpp>
#include <opencv2/core/eigen.hpp>

namespace homeward
{

/** The markers that a kind of target bears. */
inline cv::Ptr<cv::aruco::Dictionary> dictionaryOf(TargetKind kind)
{
  return cv::aruco::getPredefinedDictionary(
      kind == TargetKind::AprilGrid ? cv::aruco::DICT_APRILTAG_36h11 : cv::aruco::DICT_5X5_1000);
}

/** A marker's cells row by row, its black border included: 0 is black, 1 white. */
using MarkerCells = Eigen::MatrixXd;

inline MarkerCells markerCells(TargetKind kind, int id)
{
  const cv::Ptr<cv::aruco::Dictionary> dictionary = dictionaryOf(kind);
  cv::Mat image;
  dictionary->drawMarker(id, dictionary->markerSize + 2, image, 1);
  MarkerCells cells;
  cv::cv2eigen(image, cells);
  return cells / 255.0;
}

} // namespace homeward
