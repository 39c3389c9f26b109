// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/bearing_homing.h>

#include "planar_motion.h"
#include "scale_matches.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace homeward
{

namespace
{

/** Inliers that make the answer as sure as their agreement. */
constexpr double kAmpleInliers = 30.0;

/** Smallest and largest distance proxy given. */
constexpr double kLeastProxy = 0.005;
constexpr double kMostProxy = 3.0;

/** Standard deviation of the direction at which the confidence is halved, rad. */
constexpr double kUnsureSigma = radians(15.0);

/** Lead over the best other direction, as a share of the score, of a direction beyond doubt. */
constexpr double kSureLead = 0.4;

/** Confidence of a heading change by ample inliers where nothing is known of the direction. */
constexpr double kTurnAlone = 0.15;

Eigen::Vector3d bearingOf(const PanoramaGeometry &geometry, const cv::Point2f &point)
{
  const double azimuth = geometry.azimuth(point.x);
  const double elevation = geometry.elevation(point.y);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

std::vector<BearingPair> bearingPairs(const ScaleSpaceView &current, const ScaleSpaceView &snapshot,
                                      double matchRatio)
{
  std::vector<BearingPair> pairs;
  for (const cv::DMatch &match : matchKeypoints(current, snapshot, matchRatio)) {
    const cv::KeyPoint &c = current.points[static_cast<std::size_t>(match.queryIdx)];
    const cv::KeyPoint &s = snapshot.points[static_cast<std::size_t>(match.trainIdx)];
    pairs.push_back({bearingOf(current.geometry, c.pt), bearingOf(snapshot.geometry, s.pt)});
  }
  return pairs;
}

/** Distance of the movement over that of the landmarks on the floor plan, median. */
double distanceProxy(const std::vector<BearingPair> &pairs, const PlanarMotionFit &fit)
{
  std::vector<double> relative;
  for (const std::size_t i : fit.inliers) {
    const Eigen::Vector3d &s = pairs[i].snapshot;
    const Eigen::Vector3d &c = pairs[i].current;
    const double before = wrapAngle(std::atan2(s.y(), s.x()) - fit.motion.alpha);
    const double after = wrapAngle(std::atan2(c.y(), c.x()) + fit.motion.psi - fit.motion.alpha);
    if (std::abs(std::sin(before)) < 0.5 || before * after <= 0.0) {
      continue; // nearly along the movement the bearing does not tell the distance
    }
    const double ratio = std::sin(after - before) / std::sin(after);
    relative.push_back(std::clamp(ratio, 0.0, kMostProxy));
  }
  if (relative.empty()) {
    return kMostProxy; // only landmarks ahead and behind: nothing says that home is near
  }
  const auto middle = relative.begin() + std::ssize(relative) / 2;
  std::nth_element(relative.begin(), middle, relative.end());
  return std::max(kLeastProxy, *middle);
}

double confidenceOf(const PlanarMotionFit &fit)
{
  const double ample = std::min(1.0, fit.score / kAmpleInliers);
  const double lead = std::clamp((fit.score - fit.rival) / (kSureLead * fit.score), 0.0, 1.0);
  const double ratio = fit.alphaSigma / kUnsureSigma;
  return ample * (kTurnAlone + (1.0 - kTurnAlone) * lead / (1.0 + ratio * ratio));
}

} // namespace

BearingHoming::BearingHoming(const BearingHomingOptions &options)
    : m_options(options), m_features(options.features)
{
  if (!(options.tolerance > 0.0) || options.tolerance > radians(20.0)) {
    throw LogicError("tolerance is " + std::to_string(options.tolerance) +
                     " rad, must be above 0 and at most 20 degrees");
  }
  if (options.mostSamples < 1 || options.leastMatches < 2 || options.leastInliers < 2) {
    throw LogicError("mostSamples must be positive, leastMatches and leastInliers at least 2");
  }
}

std::optional<HomeVector> BearingHoming::compute(const Panorama &current, const Panorama &snapshot)
{
  return match(prepare(current), prepare(snapshot));
}

ScaleSpaceView BearingHoming::prepare(const Panorama &panorama) const
{
  return m_features.prepare(panorama);
}

std::optional<HomeVector> BearingHoming::match(const ScaleSpaceView &current,
                                               const ScaleSpaceView &snapshot) const
{
  const std::vector<BearingPair> pairs =
      bearingPairs(current, snapshot, m_options.features.matchRatio);
  if (std::ssize(pairs) < m_options.leastMatches) {
    return std::nullopt;
  }
  const std::optional<PlanarMotionFit> fit =
      findPlanarMotion(pairs, {m_options.tolerance, m_options.mostSamples});
  if (!fit || std::ssize(fit->inliers) < m_options.leastInliers) {
    return std::nullopt;
  }
  HomeVector home;
  home.direction = wrapAngle(fit->motion.alpha + kPi - fit->motion.psi);
  home.headingChange = wrapAngle(fit->motion.psi);
  home.distanceProxy = distanceProxy(pairs, *fit);
  home.confidence = confidenceOf(*fit);
  return home;
}

} // namespace homeward
