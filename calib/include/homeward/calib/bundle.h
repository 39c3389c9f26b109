// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/camera/camera_model.h>

#include <Eigen/Geometry>

#include <memory>
#include <vector>

namespace homeward
{

/** What a residual of length r costs, with s = r / scale. */
enum class Loss
{
  Squares, ///< r^2
  Huber,   ///< r^2 up to s = 2, straight from there
  Tukey    ///< flat from s = 5
};

/** Which points count, one a point of every view. */
using PointMask = std::vector<std::vector<bool>>;

/** A camera and where it saw the targets from. */
struct BundleState
{
  std::shared_ptr<const CameraModel> model; ///< the camera
  std::vector<Eigen::Isometry3d> cMo;       ///< one a view
};

/** How a bundle is adjusted. */
struct BundleOptions
{
  std::vector<bool> estimated; ///< one a parameter of the model; the others are held
  Loss loss = Loss::Squares;   ///< how much errors count
  double scale = 1.0;          ///< pixels
  int iterations = 100;        ///< at most
  double still = 1e-12;        ///< it rests when a step promises less than this share of the cost
  bool holdPoses = false;      ///< only the camera is adjusted
};

/** An adjusted bundle. */
struct BundleResult
{
  BundleState state;      ///< where it ended
  double cost = 0.0;      ///< pixels^2
  int iterations = 0;     ///< taken
  bool converged = false; ///< further steps would change nothing
  /** Inverse covariance of the estimated parameters for residuals of one pixel, poses free. */
  Eigen::MatrixXd information;
};

/**
 * Minimises the residuals over camera and poses together: Levenberg-Marquardt with the poses, each
 * a motion of the camera in se(3), eliminated by the Schur complement (\cite Triggs2000, section
 * 6). A point that the model cannot see costs the picture's diagonal.
 * @throw LogicError when the sizes of views, poses, mask and estimated do not agree
 */
BundleResult adjustBundle(const std::vector<BoardView> &views, const PointMask &mask,
                          const BundleState &start, const BundleOptions &options);

/** Seen minus predicted, pixels; NaN where the model cannot see the point. */
std::vector<Eigen::Vector2d> residuals(const BoardView &view, const CameraModel &model,
                                       const Eigen::Isometry3d &cMo);

} // namespace homeward
