// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/camera/camera_model.h>

#include <Eigen/Geometry>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** How the calibration is estimated. */
struct CalibrationOptions
{
  std::string model = "unified";  ///< CameraModel::name()
  bool estimateDistortion = true; ///< of the unified model as much as the views show to be there
  bool crossValidate = true;      ///< leave one view out, intrinsics fixed, its pose refitted
  int starts = 3;                 ///< how many of the best starts are followed to their end
};

/** One view after calibration. */
struct CalibratedView
{
  /** Target in frame c; see Calibration::mirrored for solid targets. */
  Eigen::Isometry3d cMo = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector2d> residuals; ///< seen minus predicted, pixels, one a point
  std::vector<bool> outliers;             ///< points the robust estimate does not believe
  double rms = 0.0;                       ///< pixels, per point, outliers left out
  /** Pixels, when this view was left out; nothing where the camera then does not see it. */
  std::optional<double> heldoutRms;
};

/** What calibrate() found. */
struct Calibration
{
  std::shared_ptr<const CameraModel> model; ///< the camera, as measured
  /**
   * Of the parameters, in their order; zero where held. With cross-validation no smaller than the
   * parameters' scatter when views are left out.
   */
  Eigen::MatrixXd covariance;
  std::vector<bool> estimated;       ///< which parameters are; the others are held at zero
  std::vector<CalibratedView> views; ///< as the views given
  double rms = 0.0;                  ///< pixels, all points
  double robustRms = 0.0;            ///< pixels, outliers left out
  std::optional<double> heldoutRms;  ///< pixels, over all views left out in turn
  int outliers = 0;                  ///< points that count little or nothing
  /**
   * Frame c is left-handed: the targets' points run the other way round in the picture than on the
   * target, as in any unflipped mirror picture. A flat target's pose is the same proper motion
   * either way; a solid target's point is cMo (x, y, -z). Flat targets tell it only when their
   * points are numbered on the target itself (x right, y down, as printed), not in the picture.
   */
  bool mirrored = false;
  /** Of the hyperbola, parabola (1) or ellipse that xi means; nothing for xi > 1 and other models.
   */
  std::optional<double> mirrorEccentricity;
  std::vector<std::string> warnings; ///< one sentence each, what to do

  /** Of the parameters, in their order, 1 on the diagonal; zero where held. */
  Eigen::MatrixXd correlations() const;
};

/**
 * Calibrates a central camera from views of flat or solid targets, without a guess.
 * @throw ConfigError with one sentence that says what to do, when the views do not allow it
 */
Calibration calibrate(const BoardViews &views, const CalibrationOptions &options = {});

/**
 * The same with a model to begin with; it is one start beside those that need no guess, so a bad
 * one does no harm.
 * @throw ConfigError as above; LogicError when start has another picture size or is not `unified`
 */
Calibration calibrateFromStart(const BoardViews &views, const CameraModel &start,
                               const CalibrationOptions &options = {});

} // namespace homeward
