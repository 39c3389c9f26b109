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
  std::string model = "unified"; ///< CameraModel::name()
  bool estimateDistortion = true;
  bool crossValidate = true; ///< leave one view out, intrinsics fixed, its pose refitted
  int starts = 0;            ///< how many starts are tried; 0: as many as it takes
};

/** One view after calibration. */
struct CalibratedView
{
  Eigen::Isometry3d cMo;                  ///< target in frame c
  std::vector<Eigen::Vector2d> residuals; ///< seen minus predicted, pixels, one a point
  std::vector<bool> outliers;             ///< points the robust estimate does not believe
  double rms = 0.0;                       ///< pixels, per point, outliers left out
  std::optional<double> heldoutRms;       ///< pixels, when this view was left out
};

/** What calibrate() found. */
struct Calibration
{
  std::shared_ptr<const CameraModel> model;
  Eigen::MatrixXd covariance;        ///< of the parameters, in their order
  std::vector<CalibratedView> views; ///< as the views given
  double rms = 0.0;                  ///< pixels, all points
  double robustRms = 0.0;            ///< pixels, outliers left out
  std::optional<double> heldoutRms;  ///< pixels, over all views left out in turn
  int outliers = 0;
  std::vector<std::string> warnings; ///< one sentence each, what to do
};

/**
 * Calibrates a central camera from views of flat or solid targets, without a guess.
 * @throw ConfigError with one sentence that says what to do, when the views do not allow it
 */
Calibration calibrate(const BoardViews &views, const CalibrationOptions &options = {});

} // namespace homeward
