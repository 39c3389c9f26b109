// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/photometric_offset.h>

#include "visible_mask.h"

#include <homeward/camera/gray_picture.h>
#include <homeward/core/error.h>

#include <Eigen/Eigenvalues>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{

namespace
{

constexpr int kMostSteps = 20;
/** Of a step, in units of the range and in rad. */
constexpr double kConverged = 1e-5;
/** As much may be left of the way when no step helps any more; a way out of reach leaves more. */
constexpr double kSettled = 5e-3;
/** Smallest over largest singular value. */
constexpr double kLeastConditioning = 1e-2;

/** Of 8-bit pictures, gray levels. */
const double kRounding = 1.0 / std::sqrt(12.0);

using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/** Two gray pictures of one geometry, and where both show the scene (255). */
struct Pair
{
  cv::Mat current;
  cv::Mat stored;
  cv::Mat visible;
  PanoramaGeometry geometry;
};

/** At half the size while cells keep at least 2 x 2 pixels: it is their averages that count. */
Pair reduced(Pair pair, const PhotometricOptions &options)
{
  PanoramaGeometry &g = pair.geometry;
  while (g.width % 2 == 0 && g.height % 2 == 0 && g.width >= 4 * options.columns &&
         g.height >= 4 * options.rows) {
    g.width /= 2;
    g.height /= 2;
    for (cv::Mat *picture : {&pair.current, &pair.stored, &pair.visible}) {
      cv::Mat half;
      cv::resize(*picture, half, {g.width, g.height}, 0.0, 0.0, cv::INTER_AREA);
      *picture = half;
    }
    pair.visible = pair.visible == 255;
  }
  return pair;
}

/** The two pictures when the camera is believed at hMp. */
struct Comparison
{
  Pose2 hMp;
  Eigen::VectorXd error; ///< current - predicted
  Jacobian J;            ///< d predicted for (x, y) of p in units of the range, and heading
  double correlation = 0.0;
  double contrast = 0.0; ///< of the current picture, gray levels

  double cost() const { return error.squaredNorm(); }
};

/** The stored picture as it would look from elsewhere. */
struct Prediction
{
  Panorama panorama;
  cv::Mat visible;
};

Prediction predict(const Pair &pair, const PhotometricSphere &sphere, const Pose2 &hMp)
{
  const PanoramaGeometry &g = pair.geometry;
  cv::Mat mapX(g.height, g.width, CV_32F);
  cv::Mat mapY(g.height, g.width, CV_32F);
  for (int v = 0; v < g.height; ++v) {
    const double elevation = g.elevation(v);
    const double flat = sphere.range(elevation) * std::cos(elevation);
    const double up = sphere.range(elevation) * std::sin(elevation);
    for (int u = 0; u < g.width; ++u) {
      const double azimuth = g.azimuth(u);
      const Eigen::Vector2d seen =
          hMp * Eigen::Vector2d(flat * std::cos(azimuth), flat * std::sin(azimuth));
      mapX.at<float>(v, u) = static_cast<float>(g.column(std::atan2(seen.y(), seen.x())) + 1.0);
      mapY.at<float>(v, u) = static_cast<float>(g.row(std::atan2(up, seen.norm())));
    }
  }
  const auto look = [&](const cv::Mat &picture) {
    cv::Mat wide;
    cv::copyMakeBorder(picture, wide, 0, 0, 1, 1, cv::BORDER_WRAP);
    cv::Mat seen;
    cv::remap(wide, seen, mapX, mapY, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    return seen;
  };
  return {{look(pair.stored), g}, look(pair.visible) == 255};
}

std::optional<Comparison> compare(const Pair &pair, const PhotometricSphere &sphere,
                                  const Pose2 &hMp)
{
  const Prediction prediction = predict(pair, sphere, hMp);
  const std::optional<PhotometricSample> seen =
      sphere.measure({pair.current, pair.geometry}, prediction.visible);
  const std::optional<PhotometricSample> predicted =
      sphere.measure(prediction.panorama, prediction.visible);
  if (!seen || !predicted) {
    return std::nullopt;
  }
  const double range = sphere.options().range;
  Comparison comparison{hMp, seen->values - predicted->values, Jacobian(sphere.size(), 3),
                        seen->values.dot(predicted->values), seen->contrast};
  // The mean of both ends' derivatives is right to the second order.
  comparison.J.col(0) = (seen->changes.col(0) + predicted->changes.col(0)) * (range / 2.0);
  comparison.J.col(1) = (seen->changes.col(1) + predicted->changes.col(1)) * (range / 2.0);
  comparison.J.col(2) = (seen->changes.col(5) + predicted->changes.col(5)) / 2.0;
  return comparison;
}

/** The next step by Levenberg and Marquardt; nothing when a freedom does not show. */
std::optional<Eigen::Vector3d> stepFrom(const Comparison &here, double damping)
{
  Eigen::Matrix3d H = here.J.transpose() * here.J;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(H, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d &values = solver.eigenvalues();
  if (!(values[0] > kLeastConditioning * kLeastConditioning * values[2])) {
    return std::nullopt;
  }
  H.diagonal() *= 1.0 + damping;
  return H.ldlt().solve(here.J.transpose() * here.error);
}

bool near(const Pose2 &hMp, const PhotometricOffsetOptions &options)
{
  return hMp.translation().norm() <= options.reach && std::abs(hMp.heading) <= options.turn;
}

Eigen::Matrix3d covarianceOf(const Comparison &found, const PhotometricSphere &sphere)
{
  const auto seen = static_cast<double>((found.J.rowwise().squaredNorm().array() > 0.0).count());
  const double independent = std::max(1.0, seen / sphere.cellsOfLowPass() - 3.0);
  const double range = sphere.options().range;
  const Eigen::Vector3d units(range, range, 1.0);
  const Eigen::Matrix3d H = found.J.transpose() * found.J;
  const double rounding = kRounding / found.contrast;
  const double variance = std::max(found.cost(), rounding * rounding) / independent;
  return units.asDiagonal() * H.inverse() * units.asDiagonal() * variance;
}

void checkOptions(const PhotometricOffsetOptions &options)
{
  if (!(options.reach > 0.0) || !(options.turn > 0.0)) {
    throw LogicError("photometric offset has reach " + std::to_string(options.reach) +
                     " and turn " + std::to_string(options.turn) + ", must be positive");
  }
}

} // namespace

std::optional<PhotometricOffset> photometricOffset(const Panorama &current, const Panorama &stored,
                                                   const PhotometricOffsetOptions &options,
                                                   const cv::Mat &visible)
{
  checkOptions(options);
  if (!(current.geometry == stored.geometry)) {
    throw LogicError("photometric offset of two panoramas of different geometry");
  }
  const Pair pair = reduced({grayPicture(current), grayPicture(stored),
                             visibleMask(stored.geometry, visible), stored.geometry},
                            options.sphere);
  const PhotometricSphere sphere(pair.geometry, options.sphere);
  std::optional<Comparison> best = compare(pair, sphere, {});
  double damping = 1e-3;
  for (int step = 0; best && step < kMostSteps; ++step) {
    const std::optional<Eigen::Vector3d> delta = stepFrom(*best, damping);
    if (!delta || !(delta->norm() > kConverged)) {
      break;
    }
    const double range = options.sphere.range;
    const Pose2 next = best->hMp * Pose2{(*delta)[0] * range, (*delta)[1] * range, (*delta)[2]};
    const std::optional<Comparison> tried =
        near(next, options) ? compare(pair, sphere, next) : std::nullopt;
    const bool better = tried && tried->cost() < best->cost();
    best = better ? tried : best;
    damping *= better ? 0.2 : 8.0;
  }
  if (!best || best->correlation < options.leastCorrelation) {
    return std::nullopt;
  }
  const std::optional<Eigen::Vector3d> left = stepFrom(*best, 0.0);
  if (!left || !(left->norm() < kSettled)) {
    return std::nullopt;
  }
  return PhotometricOffset{best->hMp, covarianceOf(*best, sphere), best->correlation};
}

} // namespace homeward
