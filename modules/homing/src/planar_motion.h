// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace homeward
{

/** Unit vectors to one landmark, z up: in frame p of the current view and of the snapshot. */
struct BearingPair
{
  Eigen::Vector3d current;
  Eigen::Vector3d snapshot;
};

/** Movement on a floor from the snapshot's place to the current one, but for its length. */
struct PlanarMotion
{
  double alpha = 0.0; ///< bearing of the current place in the snapshot's frame, rad
  double psi = 0.0;   ///< heading(current) - heading(snapshot), rad
};

/**
 * Movements, up to four, under which two landmarks meet the epipolar constraint
 *
 *     (R(psi) c) . (d x s) = 0,  d = (cos(alpha), sin(alpha), 0),
 *
 * which for movement on a floor is linear in (cos, sin) of alpha and of psi - alpha: eliminating
 * the latter leaves a quadratic. \cite Ortin2001
 */
std::vector<PlanarMotion> solvePlanarMotion(const BearingPair &first, const BearingPair &second);

/**
 * Angle (as a chord) from the current bearing to where the movement could have brought the
 * landmark: the great circle's arc from its old bearing (a landmark far away) to -d (one just
 * passed). Only landmarks in front of both views lie on it.
 */
double bearingResidual(const BearingPair &pair, const PlanarMotion &motion);

/** What findPlanarMotion() may be told. */
struct PlanarMotionOptions
{
  double tolerance = 0.02; ///< residuals from here on are outliers, rad
  int mostSamples = 1000;  ///< pairs of landmarks tried
};

/** A movement and what speaks for it. */
struct PlanarMotionFit
{
  PlanarMotion motion;
  double score = 0.0;      ///< sum of 1 - (residual / tolerance)^2 over the inliers
  double rival = 0.0;      ///< best score of a movement whose home lies more than 60 degrees off
  double alphaSigma = 0.0; ///< of alpha, by the residuals and their Jacobian, rad; at most pi
  std::vector<std::size_t> inliers; ///< indices of the pairs
};

/**
 * The movement that most landmarks agree with: two at a time are solved for, all are scored, the
 * best is refined by least squares with Tukey's weights. The same pairs give the same answer.
 * @return nothing when no movement has two inliers
 */
std::optional<PlanarMotionFit> findPlanarMotion(const std::vector<BearingPair> &pairs,
                                                const PlanarMotionOptions &options);

} // namespace homeward
