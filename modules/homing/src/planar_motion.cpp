// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_motion.h"

#include <homeward/core/angle.h>
#include <homeward/core/random.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Seed of the samples: any, but always the same. */
constexpr std::uint64_t kSeed = 1;

/** A sample without outliers is drawn with this probability. */
constexpr double kSampleSuccess = 0.999;

constexpr int kRefinements = 12;

/** Residuals are known no better than this, rad: a third of a column of 720. */
constexpr double kLeastSigma = 0.003;

/** Step of numeric derivatives, rad. */
constexpr double kStep = 1e-5;

/** Sine of the angle between two bearings that count as the same or as opposite. */
constexpr double kParallel = 1e-9;

struct Scored
{
  PlanarMotion motion;
  double score = 0.0;
};

Vector3d turned(const Vector3d &bearing, double angle)
{
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * bearing.x() - s * bearing.y(), s * bearing.x() + c * bearing.y(), bearing.z()};
}

/** How the constraint weighs (cos, sin) of psi - alpha (rows first) and of alpha. */
Vector2d turnRow(const BearingPair &pair)
{
  return pair.snapshot.z() * Vector2d(pair.current.y(), pair.current.x());
}

Vector2d directionRow(const BearingPair &pair)
{
  return pair.current.z() * Vector2d(pair.snapshot.y(), -pair.snapshot.x());
}

double scoreOf(const std::vector<BearingPair> &pairs, const PlanarMotion &motion, double tolerance)
{
  double score = 0.0;
  for (const BearingPair &pair : pairs) {
    const double relative = bearingResidual(pair, motion) / tolerance;
    score += std::max(0.0, 1.0 - relative * relative);
  }
  return score;
}

/** Bearing of home in the current frame, rad. */
double homeOf(const PlanarMotion &motion)
{
  return motion.alpha + kPi - motion.psi;
}

/** Samples that find two inliers among so many pairs, at most `most`. */
int samplesNeeded(double inliers, double count, int most)
{
  const double hit = std::pow(std::min(1.0, inliers / count), 2);
  const double needed = hit < 1.0 ? std::log(1.0 - kSampleSuccess) / std::log1p(-hit) : 1.0;
  return needed < most ? static_cast<int>(std::ceil(needed)) : most;
}

/** Everything that two pairs at a time propose. */
std::vector<Scored> sampled(const std::vector<BearingPair> &pairs,
                            const PlanarMotionOptions &options)
{
  Random random(kSeed, 0);
  std::vector<Scored> found;
  double best = 0.0;
  int needed = options.mostSamples;
  for (int sample = 0; sample < needed; ++sample) {
    const std::size_t first = random.bits() % pairs.size();
    const std::size_t second =
        (first + 1 + random.bits() % (pairs.size() - 1)) % pairs.size(); // another one
    for (const PlanarMotion &motion : solvePlanarMotion(pairs[first], pairs[second])) {
      found.push_back({motion, scoreOf(pairs, motion, options.tolerance)});
      best = std::max(best, found.back().score);
    }
    needed = samplesNeeded(best, static_cast<double>(pairs.size()), options.mostSamples);
  }
  return found;
}

/** Signed angle of the current bearing from the epipolar plane. */
double planeResidual(const BearingPair &pair, double alpha, double psi)
{
  const Vector3d normal =
      Vector3d(std::cos(alpha), std::sin(alpha), 0.0).cross(pair.snapshot).normalized();
  return turned(pair.current, psi).dot(normal);
}

/** Weighted normal equations in (alpha, psi). */
struct Normal
{
  Matrix2d matrix = Matrix2d::Zero();
  Vector2d gradient = Vector2d::Zero();
  double squares = 0.0;
  double weights = 0.0;
};

Normal normalAt(const std::vector<BearingPair> &pairs, const PlanarMotion &at, double tolerance)
{
  Normal normal;
  for (const BearingPair &pair : pairs) {
    const double relative = bearingResidual(pair, at) / tolerance;
    if (!(relative < 1.0)) {
      continue;
    }
    const double weight = std::pow(1.0 - relative * relative, 2);
    const double residual = planeResidual(pair, at.alpha, at.psi);
    const Vector2d J{(planeResidual(pair, at.alpha + kStep, at.psi) -
                      planeResidual(pair, at.alpha - kStep, at.psi)) /
                         (2.0 * kStep),
                     (planeResidual(pair, at.alpha, at.psi + kStep) -
                      planeResidual(pair, at.alpha, at.psi - kStep)) /
                         (2.0 * kStep)};
    normal.matrix += weight * J * J.transpose();
    normal.gradient += weight * residual * J;
    normal.squares += weight * residual * residual;
    normal.weights += weight;
  }
  return normal;
}

Scored refined(const std::vector<BearingPair> &pairs, Scored best, double tolerance)
{
  Scored at = best;
  for (int i = 0; i < kRefinements; ++i) {
    const Normal normal = normalAt(pairs, at.motion, tolerance);
    // Without parallax any direction fits: a little damping keeps the step small.
    const double damping = 1e-4 * normal.weights + 1e-12;
    const Vector2d step =
        (normal.matrix + damping * Matrix2d::Identity()).inverse() * normal.gradient;
    at.motion.alpha = wrapAngle(at.motion.alpha - step.x());
    at.motion.psi = wrapAngle(at.motion.psi - step.y());
    at.score = scoreOf(pairs, at.motion, tolerance);
    if (at.score > best.score) {
      best = at;
    }
  }
  return best;
}

/** Standard deviation of alpha, rad, at most pi. */
double alphaSigma(const Normal &normal)
{
  const double variance =
      std::max(kLeastSigma * kLeastSigma, normal.squares / std::max(1.0, normal.weights));
  const double determinant = normal.matrix.determinant();
  const double inverse = normal.matrix(1, 1) * variance;
  return determinant * kPi * kPi > inverse ? std::sqrt(inverse / determinant) : kPi;
}

} // namespace

std::vector<PlanarMotion> solvePlanarMotion(const BearingPair &first, const BearingPair &second)
{
  Matrix2d A;
  Matrix2d B;
  A << turnRow(first).transpose(), turnRow(second).transpose();
  B << directionRow(first).transpose(), directionRow(second).transpose();
  std::vector<PlanarMotion> motions;
  if (std::abs(A.determinant()) < kParallel) {
    return motions;
  }
  const Matrix2d M = A.inverse() * B;
  // |M (cos, sin)| = 1, in twice the angle: radius cos(2 alpha - phase) = 1 - mean.
  const Matrix2d Q = M.transpose() * M;
  const double mean = 0.5 * (Q(0, 0) + Q(1, 1));
  const double half = 0.5 * (Q(0, 0) - Q(1, 1));
  const double radius = std::hypot(half, Q(0, 1));
  if (!(std::abs(1.0 - mean) <= radius)) {
    return motions;
  }
  const double phase = std::atan2(Q(0, 1), half);
  const double opening = std::acos((1.0 - mean) / std::max(radius, kParallel));
  for (const double twice : {phase + opening, phase - opening}) {
    for (const double alpha : {0.5 * twice, 0.5 * twice + kPi}) {
      const Vector2d w = M * Vector2d(std::cos(alpha), std::sin(alpha));
      motions.push_back({wrapAngle(alpha), wrapAngle(alpha + std::atan2(w.y(), w.x()))});
    }
  }
  return motions;
}

double bearingResidual(const BearingPair &pair, const PlanarMotion &motion)
{
  const Vector3d current = turned(pair.current, motion.psi);
  const Vector3d direction{std::cos(motion.alpha), std::sin(motion.alpha), 0.0};
  const Vector3d across = direction.cross(pair.snapshot);
  const double sine = across.norm();
  const bool behindStart = across.dot(pair.snapshot.cross(current)) < 0.0;
  if (sine < kParallel || behindStart) {
    return (current - pair.snapshot).norm();
  }
  if (across.dot(current.cross(direction)) > 0.0) {
    return (current + direction).norm(); // beyond the end
  }
  return std::abs(current.dot(across)) / sine;
}

std::optional<PlanarMotionFit> findPlanarMotion(const std::vector<BearingPair> &pairs,
                                                const PlanarMotionOptions &options)
{
  if (pairs.size() < 2) {
    return std::nullopt;
  }
  const std::vector<Scored> all = sampled(pairs, options);
  const auto best = std::max_element(
      all.begin(), all.end(), [](const Scored &a, const Scored &b) { return a.score < b.score; });
  if (best == all.end()) {
    return std::nullopt;
  }
  const Scored winner = refined(pairs, *best, options.tolerance);
  PlanarMotionFit fit;
  fit.motion = winner.motion;
  fit.score = winner.score;
  for (const Scored &other : all) {
    const double off = wrapAngle(homeOf(other.motion) - homeOf(winner.motion));
    fit.rival = std::abs(off) > radians(60.0) ? std::max(fit.rival, other.score) : fit.rival;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (bearingResidual(pairs[i], winner.motion) < options.tolerance) {
      fit.inliers.push_back(i);
    }
  }
  fit.alphaSigma = alphaSigma(normalAt(pairs, winner.motion, options.tolerance));
  return fit.inliers.size() < 2 ? std::nullopt : std::optional(fit);
}

} // namespace homeward
