// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/scale_space_homing.h>

#include "scale_matches.h"
#include "upright_features.h"

#include <homeward/camera/gray_picture.h>
#include <homeward/core/error.h>

#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace homeward
{

namespace
{

/** Columns repeated beyond the seam, so that keypoints there look like any other. */
constexpr int kSeamColumns = 48;

/** Matches that make the answer as sure as their agreement. */
constexpr double kAmpleMatches = 30.0;

/** Smallest distance proxy given; below it, noise decides. */
constexpr double kLeastProxy = 0.005;

/** One landmark in both views. */
struct ScaleMatch
{
  double bearing;  ///< in the current view, rad
  double turn;     ///< azimuth in the snapshot minus azimuth in the current view, rad
  double logScale; ///< log(scale in the current view / scale in the snapshot)
};

ScaleSpaceView detectSift(const Panorama &panorama, const ScaleSpaceOptions &options)
{
  const cv::Ptr<cv::SIFT> sift =
      cv::SIFT::create(options.mostKeypoints, 3, options.contrastThreshold);
  const cv::Mat gray = grayPicture(panorama);
  const int seam = std::min(kSeamColumns, gray.cols / 2);
  cv::Mat wrapped;
  cv::copyMakeBorder(gray, wrapped, 0, 0, seam, seam, cv::BORDER_WRAP);
  std::vector<cv::KeyPoint> all;
  sift->detect(wrapped, all);
  std::vector<cv::KeyPoint> kept;
  std::copy_if(all.begin(), all.end(), std::back_inserter(kept), [&](const cv::KeyPoint &point) {
    return point.pt.x >= static_cast<float>(seam) - 0.5F &&
           point.pt.x < static_cast<float>(seam + gray.cols) - 0.5F;
  });
  ScaleSpaceView found;
  found.geometry = panorama.geometry;
  sift->compute(wrapped, kept, found.descriptors);
  for (cv::KeyPoint &point : kept) {
    point.pt.x -= static_cast<float>(seam);
  }
  found.points = std::move(kept);
  return found;
}

std::vector<ScaleMatch> matchScales(const ScaleSpaceView &current, const ScaleSpaceView &snapshot,
                                    double matchRatio)
{
  std::vector<ScaleMatch> matches;
  // Keypoint sizes are in pixels of their own panorama.
  const double pixelRatio =
      static_cast<double>(snapshot.geometry.width) / static_cast<double>(current.geometry.width);
  for (const cv::DMatch &pair : matchKeypoints(current, snapshot, matchRatio)) {
    const cv::KeyPoint &c = current.points[static_cast<std::size_t>(pair.queryIdx)];
    const cv::KeyPoint &s = snapshot.points[static_cast<std::size_t>(pair.trainIdx)];
    const double bearing = current.geometry.azimuth(c.pt.x);
    const double before = snapshot.geometry.azimuth(s.pt.x);
    matches.push_back(
        {bearing, wrapAngle(before - bearing), std::log(c.size / s.size * pixelRatio)});
  }
  return matches;
}

/** The given quantile in (0, 1) of values, which are reordered. */
double quantile(std::vector<double> values, double share)
{
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/** Median of angles about their circular mean. */
double circularMedian(const std::vector<ScaleMatch> &matches)
{
  double x = 0.0;
  double y = 0.0;
  for (const ScaleMatch &match : matches) {
    x += std::cos(match.turn);
    y += std::sin(match.turn);
  }
  const double mean = std::atan2(y, x);
  std::vector<double> offsets;
  offsets.reserve(matches.size());
  for (const ScaleMatch &match : matches) {
    offsets.push_back(wrapAngle(match.turn - mean));
  }
  return wrapAngle(mean + quantile(offsets, 0.5));
}

} // namespace

ScaleSpaceHoming::ScaleSpaceHoming(const ScaleSpaceOptions &options) : m_options(options)
{
  if (!(options.matchRatio > 0.0) || options.matchRatio >= 1.0) {
    throw LogicError("matchRatio is " + std::to_string(options.matchRatio) +
                     ", must be between 0 and 1");
  }
  if (!(options.contrastThreshold > 0.0) || options.leastMatches < 1 || options.mostKeypoints < 1) {
    throw LogicError("contrastThreshold, mostKeypoints and leastMatches must be positive");
  }
}

std::optional<HomeVector> ScaleSpaceHoming::compute(const Panorama &current,
                                                    const Panorama &snapshot)
{
  ScaleSpaceView views[2];
  cv::parallel_for_({0, 2}, [&](const cv::Range &range) {
    for (int i = range.start; i < range.end; ++i) {
      views[i] = prepare(i == 0 ? current : snapshot);
    }
  });
  return match(views[0], views[1]);
}

ScaleSpaceView ScaleSpaceHoming::prepare(const Panorama &panorama) const
{
  if (m_options.published) {
    return detectSift(panorama, m_options);
  }
  UprightFeatures features =
      uprightFeatures(grayPicture(panorama), m_options.contrastThreshold, m_options.mostKeypoints);
  return {panorama.geometry, std::move(features.points), std::move(features.descriptors)};
}

std::optional<HomeVector> ScaleSpaceHoming::match(const ScaleSpaceView &current,
                                                  const ScaleSpaceView &snapshot) const
{
  const std::vector<ScaleMatch> matches = matchScales(current, snapshot, m_options.matchRatio);
  if (std::ssize(matches) < m_options.leastMatches) {
    return std::nullopt;
  }
  // n sin(b) and n cos(b), with b the circular mean, point along the plain sums.
  double contractedX = 0.0;
  double contractedY = 0.0;
  double contracted = 0.0;
  double expandedX = 0.0;
  double expandedY = 0.0;
  double expanded = 0.0;
  std::vector<double> logScales;
  logScales.reserve(matches.size());
  for (const ScaleMatch &match : matches) {
    const bool smaller = match.logScale < 0.0;
    (smaller ? contractedX : expandedX) += std::cos(match.bearing);
    (smaller ? contractedY : expandedY) += std::sin(match.bearing);
    (smaller ? contracted : expanded) += 1.0;
    logScales.push_back(std::abs(match.logScale));
  }
  const double towards = std::atan2(contractedY, contractedX);
  const double away = std::atan2(expandedY, expandedX);
  HomeVector home;
  home.direction =
      wrapAngle(std::atan2(contracted * std::sin(towards) + expanded * std::sin(away + kPi),
                           contracted * std::cos(towards) + expanded * std::cos(away + kPi)));
  const auto agreeing = std::count_if(matches.begin(), matches.end(), [&](const ScaleMatch &match) {
    const bool homeward = std::cos(match.bearing - home.direction) > 0.0;
    return homeward == (match.logScale < 0.0);
  });
  const double count = static_cast<double>(matches.size());
  const double agreement = std::max(0.0, 2.0 * static_cast<double>(agreeing) / count - 1.0);
  home.confidence = agreement * std::min(1.0, count / kAmpleMatches);
  // |log scale| is about |cos(bearing - direction)| times the relative distance: mean 2 / pi.
  home.distanceProxy = std::max(kLeastProxy, kPi / 2.0 * quantile(logScales, 0.5));
  home.headingChange = circularMedian(matches);
  return home;
}

} // namespace homeward
