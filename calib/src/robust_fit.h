// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/bundle.h>

#include <memory>
#include <vector>

namespace homeward
{

/** Standard deviation of one coordinate, from the median length: half the points may be wrong. */
double robustScale(const std::vector<BoardView> &views, const PointMask &mask,
                   const BundleState &state);

/** An adjusted bundle and the points it believes. */
struct RobustFit
{
  BundleResult bundle;
  PointMask inliers;
  double sigma = 0.0; ///< of one coordinate, from the inliers and the degrees of freedom, pixels
};

/**
 * Tukey's estimator with the scale renewed until it rests, then least squares over the points
 * nearer than five scales. \cite Comport2006
 */
RobustFit fitRobustly(const std::vector<BoardView> &views, const BundleState &start,
                      const std::vector<bool> &estimated);

/** Root mean square length of the residuals of the points in the mask; infinite when unseen. */
double rmsOf(const std::vector<Eigen::Vector2d> &residuals, const std::vector<bool> &mask);

/** Every point of every view. */
PointMask everyPoint(const std::vector<BoardView> &views);

} // namespace homeward
