// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/descent_in_image_distance.h>

#include "aligned_views.h"

#include <homeward/core/error.h>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{

namespace
{

/** Smallest and largest distance proxy given. */
constexpr double kLeastProxy = 0.005;
constexpr double kMostProxy = 3.0;

/** Added to gray levels before the logarithm. */
constexpr double kDarkLevel = 4.0;

/** Mean square of a slope, log intensity per radian, below which it tells nothing. */
constexpr double kLeastSlope = 1e-4;

/** Log intensity, low-pass filtered, without its mean; CV_32F. */
cv::Mat smoothed(const cv::Mat &gray, const PanoramaGeometry &geometry, double blur)
{
  cv::Mat logs = gray + kDarkLevel;
  cv::log(logs, logs);
  const double across = blur * geometry.width / (2.0 * kPi);
  const double up = blur * geometry.height / (geometry.elevationMax - geometry.elevationMin);
  const int reach = std::min(geometry.width, static_cast<int>(std::ceil(4.0 * across)));
  cv::Mat wide;
  cv::copyMakeBorder(logs, wide, 0, 0, reach, reach, cv::BORDER_WRAP);
  cv::GaussianBlur(wide, wide, {}, across, up, cv::BORDER_REPLICATE);
  cv::Mat middle = wide.colRange(reach, reach + geometry.width).clone();
  middle -= cv::mean(middle)[0];
  return middle;
}

/** Slopes along azimuth and elevation, per radian. */
struct Slopes
{
  cv::Mat azimuth;
  cv::Mat elevation;
};

Slopes slopesOf(const cv::Mat &picture, const PanoramaGeometry &geometry)
{
  cv::Mat wide;
  cv::copyMakeBorder(picture, wide, 1, 1, 1, 1, cv::BORDER_WRAP);
  picture.row(0).copyTo(wide(cv::Rect(1, 0, picture.cols, 1)));
  picture.row(picture.rows - 1).copyTo(wide(cv::Rect(1, picture.rows + 1, picture.cols, 1)));
  const cv::Rect inside(1, 1, picture.cols, picture.rows);
  // Columns grow clockwise and rows downwards: against both angles.
  const double perAzimuth = -geometry.width / (4.0 * kPi);
  const double perElevation =
      -geometry.height / (2.0 * (geometry.elevationMax - geometry.elevationMin));
  const auto difference = [&](const cv::Point &step, double scale) {
    return cv::Mat(scale * (wide(inside + step) - wide(inside - step)));
  };
  return {difference({1, 0}, perAzimuth), difference({0, 1}, perElevation)};
}

/** Normal equations of the movement that explains the difference. */
struct Normal
{
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d vector = Eigen::Vector2d::Zero();
  double squares = 0.0; ///< of the difference
};

Normal normalOf(const cv::Mat &difference, const Slopes &slopes, const PanoramaGeometry &geometry)
{
  Normal normal;
  for (int row = 0; row < difference.rows; ++row) {
    const double elevation = geometry.elevation(row);
    const double rise = std::sin(elevation) * std::cos(elevation);
    const double weight = std::cos(elevation); // of the solid angle
    for (int column = 0; column < difference.cols; ++column) {
      const double c = std::cos(geometry.azimuth(column));
      const double s = std::sin(geometry.azimuth(column));
      const double across = slopes.azimuth.at<float>(row, column);
      const double up = slopes.elevation.at<float>(row, column) * rise;
      const Eigen::Vector2d J{across * s + up * c, -across * c + up * s};
      const double value = difference.at<float>(row, column);
      normal.matrix += weight * J * J.transpose();
      normal.vector += weight * value * J;
      normal.squares += weight * value * value;
    }
  }
  const auto pixels = static_cast<double>(difference.total());
  return {normal.matrix / pixels, normal.vector / pixels, normal.squares / pixels};
}

} // namespace

DescentInImageDistance::DescentInImageDistance(const ImageDescentOptions &options)
    : m_options(options)
{
  if (options.columns < 36 || options.rows < 16) {
    throw LogicError("columns and rows are " + std::to_string(options.columns) + " and " +
                     std::to_string(options.rows) + ", must be at least 36 and 16");
  }
  if (!(options.blur > 0.0) || options.blur > 1.0) {
    throw LogicError("blur is " + std::to_string(options.blur) +
                     " rad, must be above 0 and at most 1");
  }
}

std::optional<HomeVector> DescentInImageDistance::compute(const Panorama &current,
                                                          const Panorama &snapshot)
{
  const std::optional<AlignedViews> views =
      alignByCompass(current, snapshot, m_options.columns, m_options.rows);
  if (!views) {
    return std::nullopt;
  }
  const cv::Mat here = smoothed(views->current, views->geometry, m_options.blur);
  const cv::Mat there = smoothed(views->snapshot, views->geometry, m_options.blur);
  // The slopes halfway are right to the second order.
  const Slopes slopes = slopesOf(0.5 * (here + there), views->geometry);
  const Normal normal = normalOf(there - here, slopes, views->geometry);
  const double determinant = normal.matrix.determinant();
  if (!(determinant > kLeastSlope * kLeastSlope)) {
    return std::nullopt;
  }
  const Eigen::Vector2d moved = normal.matrix.inverse() * normal.vector;
  const double explained = normal.squares > 0.0 ? moved.dot(normal.vector) / normal.squares : 1.0;
  return HomeVector{wrapAngle(std::atan2(-moved.y(), -moved.x())),
                    std::clamp(moved.norm(), kLeastProxy, kMostProxy), views->compass.headingChange,
                    views->compass.confidence * std::sqrt(std::clamp(explained, 0.0, 1.0))};
}

} // namespace homeward
