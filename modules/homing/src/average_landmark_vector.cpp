// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/average_landmark_vector.h>

#include "aligned_views.h"

#include <homeward/core/error.h>

#include <Eigen/Core>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace homeward
{

namespace
{

/** Smallest distance proxy given; below it, noise decides. */
constexpr double kLeastProxy = 0.005;

/** Added to gray levels before the logarithm: noise in the dark is no edge. */
constexpr double kDarkLevel = 4.0;

/** Mean log intensity of each column, at most `band` off the horizon; CV_32F, one row. */
cv::Mat horizonOf(const cv::Mat &gray, const PanoramaGeometry &geometry, double band)
{
  const auto row = [&](double elevation) {
    return std::clamp(static_cast<int>(std::lround(geometry.row(elevation))), 0, gray.rows - 1);
  };
  cv::Mat logs = gray.rowRange(row(band), row(-band) + 1) + kDarkLevel;
  cv::log(logs, logs);
  cv::Mat horizon;
  cv::reduce(logs, horizon, 0, cv::REDUCE_AVG);
  return horizon;
}

/**
 * Mean unit vector to the edges, nothing without any. An edge is where the horizon's slope is
 * steepest, however steep: one landmark each, near or far.
 */
std::optional<Eigen::Vector2d> averageLandmark(const cv::Mat &horizon,
                                               const PanoramaGeometry &geometry, double contrast)
{
  const int width = horizon.cols;
  const auto level = [&](int column) { return horizon.at<float>(0, (column + width) % width); };
  std::vector<double> slopes; // one more column on either side
  for (int column = -1; column <= width; ++column) {
    slopes.push_back(std::abs(level(column + 1) - level(column - 1)));
  }
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (int column = 0; column < width; ++column) {
    const auto i = static_cast<std::size_t>(column) + 1;
    if (slopes[i] > 2.0 * contrast && slopes[i] > slopes[i - 1] && slopes[i] >= slopes[i + 1]) {
      const double azimuth = geometry.azimuth(column);
      sum += Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
      ++count;
    }
  }
  return count == 0 ? std::nullopt : std::optional<Eigen::Vector2d>(sum / count);
}

} // namespace

AverageLandmarkVector::AverageLandmarkVector(const AverageLandmarkOptions &options)
    : m_options(options)
{
  if (options.columns < 36 || options.rows < 16) {
    throw LogicError("columns and rows are " + std::to_string(options.columns) + " and " +
                     std::to_string(options.rows) + ", must be at least 36 and 16");
  }
  if (!(options.edgeContrast > 0.0)) {
    throw LogicError("edgeContrast is " + std::to_string(options.edgeContrast) +
                     ", must be positive");
  }
  if (!(options.band > 0.0)) {
    throw LogicError("band is " + std::to_string(options.band) + " rad, must be positive");
  }
}

std::optional<HomeVector> AverageLandmarkVector::compute(const Panorama &current,
                                                         const Panorama &snapshot)
{
  const std::optional<AlignedViews> views =
      alignByCompass(current, snapshot, m_options.columns, m_options.rows);
  if (!views) {
    return std::nullopt;
  }
  const auto landmark = [&](const cv::Mat &view) {
    return averageLandmark(horizonOf(view, views->geometry, m_options.band), views->geometry,
                           m_options.edgeContrast);
  };
  const std::optional<Eigen::Vector2d> here = landmark(views->current);
  const std::optional<Eigen::Vector2d> there = landmark(views->snapshot);
  if (!here || !there) {
    return std::nullopt;
  }
  const Eigen::Vector2d home = *here - *there;
  return HomeVector{wrapAngle(std::atan2(home.y(), home.x())),
                    std::max(kLeastProxy, 2.0 * home.norm()), views->compass.headingChange,
                    views->compass.confidence};
}

} // namespace homeward
