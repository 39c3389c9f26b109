// SPDX-License-Identifier: GPL-3.0-or-later
#include "scale_matches.h"

#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace homeward
{

namespace
{

/** All compared with all. */
std::vector<cv::DMatch> matchAll(const ScaleSpaceView &current, const ScaleSpaceView &snapshot,
                                 double matchRatio)
{
  std::vector<std::vector<cv::DMatch>> pairs;
  cv::BFMatcher(cv::NORM_L2).knnMatch(current.descriptors, snapshot.descriptors, pairs, 2);
  std::vector<cv::DMatch> matches;
  for (const std::vector<cv::DMatch> &pair : pairs) {
    if (pair[0].distance < matchRatio * pair[1].distance) {
      matches.push_back(pair[0]);
    }
  }
  return matches;
}

/** The least two of at least two values: their places. */
std::pair<int, int> leastTwo(const int *values, int count)
{
  int best = values[0] < values[1] ? 0 : 1;
  int second = 1 - best;
  for (int k = 2; k < count; ++k) {
    if (values[k] < values[best]) {
      second = best;
      best = k;
    }
    else if (values[k] < values[second]) {
      second = k;
    }
  }
  return {best, second};
}

std::vector<cv::DMatch> matchByElevation(const ScaleSpaceView &current,
                                         const ScaleSpaceView &snapshot, double matchRatio)
{
  constexpr double kGrowth = 2.5;        // of the tangent of an elevation, as one comes nearer
  constexpr double kTilt = radians(2.5); // of robot and mirror, and errors of the features
  std::vector<double> elevations;        // falling: features are sorted from top to bottom
  for (const cv::KeyPoint &point : snapshot.points) {
    elevations.push_back(snapshot.geometry.elevation(point.pt.y));
  }
  const auto firstBelow = [&](double elevation) {
    return static_cast<int>(
        std::upper_bound(elevations.begin(), elevations.end(), elevation, std::greater<>()) -
        elevations.begin());
  };
  std::vector<cv::DMatch> matches;
  cv::Mat distances;
  for (int i = 0; i < current.descriptors.rows; ++i) {
    const double elevation =
        current.geometry.elevation(current.points[static_cast<std::size_t>(i)].pt.y);
    const auto [low, high] = std::minmax(
        {std::atan(std::tan(elevation) * kGrowth), std::atan(std::tan(elevation) / kGrowth)});
    const int first = firstBelow(high + kTilt);
    const int last = firstBelow(low - kTilt);
    if (last - first < 2) {
      continue;
    }
    cv::batchDistance(current.descriptors.row(i), snapshot.descriptors.rowRange(first, last),
                      distances, CV_32S, cv::noArray(), cv::NORM_L1);
    const int *values = distances.ptr<int>();
    const auto [best, second] = leastTwo(values, distances.cols);
    if (values[best] < matchRatio * values[second]) {
      matches.emplace_back(i, first + best, static_cast<float>(values[best]));
    }
  }
  return matches;
}

} // namespace

std::vector<cv::DMatch> matchKeypoints(const ScaleSpaceView &current,
                                       const ScaleSpaceView &snapshot, double matchRatio)
{
  if (current.points.size() < 2 || snapshot.points.size() < 2) {
    return {};
  }
  return current.descriptors.depth() == CV_8U ? matchByElevation(current, snapshot, matchRatio)
                                              : matchAll(current, snapshot, matchRatio);
}

} // namespace homeward
