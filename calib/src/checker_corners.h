// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace homeward
{

/** A place where two dark and two bright sectors meet. */
struct CheckerCorner
{
  Eigen::Vector2d pixel;
  Eigen::Vector2d rising;  ///< unit vector along the edge with the bright side counter-clockwise
  Eigen::Vector2d falling; ///< likewise along the other edge, bright side clockwise
  double contrast = 0.0;   ///< gray levels
};

/**
 * Corners of checkers, by the saddles of a smoothed picture whose surroundings change from dark to
 * bright twice in a turn. Counter-clockwise means from u to v, along growing angles of the picture.
 * @param smooth CV_8UC1, blurred by about a pixel
 */
std::vector<CheckerCorner> checkerCorners(const cv::Mat1b &smooth);

/**
 * Whether one straight edge joins two places: dark on one side and bright on the other, all the way
 * and not the other way round after a checker.
 * @param brightLeft the bright side is counter-clockwise of the way from `from` to `to`
 * @param contrast least difference of the sides, gray levels
 */
bool joinedByEdge(const cv::Mat1b &smooth, const Eigen::Vector2d &from, const Eigen::Vector2d &to,
                  bool brightLeft, double contrast);

} // namespace homeward
