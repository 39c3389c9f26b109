// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/calibration.h>

#include "findings.h"
#include "robust_fit.h"
#include "starting.h"

#include <homeward/calib/convert.h>
#include <homeward/camera/camera_models.h>
#include <homeward/core/error.h>
#include <homeward/core/symmetric_eigen.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace homeward
{
namespace
{

/** The views with every target seen from its back, as a left-handed frame c sees it. */
BoardViews mirroredViews(BoardViews views)
{
  for (BoardView &view : views.views) {
    for (Eigen::Vector3d &point : view.board) {
      point.z() = -point.z();
    }
  }
  return views;
}

/** The unified model as the one that was asked for, poses as they are. */
BundleState asModel(const BoardViews &views, const BundleState &state,
                    const CalibrationOptions &options)
{
  if (options.model == "unified") {
    return state;
  }
  std::vector<Eigen::Vector2d> pixels;
  for (const BoardView &view : views.views) {
    pixels.insert(pixels.end(), view.pixels.begin(), view.pixels.end());
  }
  return {fitModel(*state.model, options.model, pixels, options.estimateDistortion).model,
          state.cMo};
}

struct Fitted
{
  RobustFit fit;
  std::vector<bool> estimated;
  bool mirrored = false;
};

/** The parameters of a model that a set of names leaves free; `fewest` are free in any case. */
std::vector<bool> alsoFree(const CameraModel &model, std::vector<bool> fewest,
                           const std::string &letters)
{
  const auto names = model.parameterNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    fewest[i] = fewest[i] || letters.find(names[i].front()) != std::string::npos;
  }
  return fewest;
}

/**
 * The distortion that pays, by the Bayesian information criterion on one set of points: parameters
 * that explain nothing would only blur the others and bend the picture where no target stood.
 */
Fitted withDistortionThatPays(const BoardViews &views, const BundleState &state)
{
  const auto fewest = freeParameters(*state.model, false);
  const auto most = freeParameters(*state.model, true);
  Fitted best{fitRobustly(views.views, state, most), most};
  if (state.model->name() != "unified") {
    return best;
  }
  double points = 0.0;
  for (const auto &view : best.fit.inliers) {
    points += 2.0 * static_cast<double>(std::count(view.begin(), view.end(), true));
  }
  BundleOptions options;
  options.still = 1e-9;
  const auto criterion = [&](const std::vector<bool> &estimated) {
    options.estimated = estimated;
    const double cost = adjustBundle(views.views, best.fit.inliers, state, options).cost;
    const auto count = static_cast<double>(std::count(estimated.begin(), estimated.end(), true));
    return points * std::log(cost / points + 1e-12) + count * std::log(points);
  };
  double lowest = criterion(most);
  for (const char *letters : {"kp", "k", "p", ""}) {
    const auto estimated = alsoFree(*state.model, fewest, letters);
    const double here = criterion(estimated);
    if (here < lowest) {
      lowest = here;
      best.estimated = estimated;
    }
  }
  if (best.estimated != most) {
    best.fit = fitRobustly(views.views, state, best.estimated);
  }
  return best;
}

Fitted fitted(const BoardViews &views, const Eigen::Vector2d &centre, const CameraModel *start,
              const CalibrationOptions &options, bool mirrored)
{
  const auto started = findStart(views, centre, start, options.starts);
  if (!started) {
    throw ConfigError("no camera explains these views: check the target's measures, the order of "
                      "its points and the picture's size");
  }
  const BundleState state = asModel(views, started->state, options);
  const auto fewest = freeParameters(*state.model, false);
  Fitted result = options.estimateDistortion
                      ? withDistortionThatPays(views, state)
                      : Fitted{fitRobustly(views.views, state, fewest), fewest};
  result.mirrored = mirrored;
  return result;
}

/** Covariance of all parameters from the information of the estimated ones. */
Eigen::MatrixXd covarianceOf(const RobustFit &fit, const std::vector<bool> &estimated)
{
  const auto n = static_cast<Eigen::Index>(estimated.size());
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < estimated.size(); ++i) {
    if (estimated[i]) {
      columns.push_back(static_cast<Eigen::Index>(i));
    }
  }
  const Eigen::MatrixXd &information = fit.bundle.information;
  const Eigen::VectorXd scale = information.diagonal().array().max(1e-300).rsqrt();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const SymmetricEigen eigen = symmetricEigen(scaled);
  constexpr double kSingular = 1e-13;
  if (!(eigen.values[0] > kSingular)) {
    throw ConfigError("the views do not determine the camera: hold the target nearer, tilted in "
                      "different ways and all round the picture, or calibrate without distortion");
  }
  const Eigen::MatrixXd inverse = scale.asDiagonal() * eigen.vectors *
                                  eigen.values.cwiseInverse().asDiagonal() *
                                  eigen.vectors.transpose() * scale.asDiagonal();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      covariance(columns[i], columns[k]) =
          fit.sigma * fit.sigma *
          inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
  return covariance;
}

/** What the other views say of one of them and of the camera. */
struct LeftOut
{
  double rms = 0.0;           ///< of the view, its pose refitted; pixels
  Eigen::VectorXd parameters; ///< of the camera
};

LeftOut leftOut(const BoardViews &views, const RobustFit &fit, std::size_t which,
                const std::vector<bool> &estimated)
{
  BundleState others = fit.bundle.state;
  std::vector<BoardView> rest = views.views;
  PointMask mask = fit.inliers;
  const auto at = static_cast<std::ptrdiff_t>(which);
  rest.erase(rest.begin() + at);
  mask.erase(mask.begin() + at);
  others.cMo.erase(others.cMo.begin() + at);
  BundleOptions options;
  options.estimated = estimated;
  const auto without = adjustBundle(rest, mask, others, options);

  options.estimated.assign(estimated.size(), false);
  const BundleState alone{without.state.model, {fit.bundle.state.cMo[which]}};
  const auto refitted =
      adjustBundle({views.views[which]}, {fit.inliers[which]}, alone, options).state;
  return {
      rmsOf(residuals(views.views[which], *refitted.model, refitted.cMo[0]), fit.inliers[which]),
      without.state.model->parameters()};
}

/**
 * How much wider the parameters scatter than points that err independently of each other would let
 * them, as a factor of the covariance, at least 1: errors of one picture go together. The jackknife
 * over views, against the information. \cite Efron1982
 */
double spreadOverViews(const std::vector<Eigen::VectorXd> &withoutOne, const RobustFit &fit,
                       const std::vector<bool> &estimated)
{
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < estimated.size(); ++i) {
    if (estimated[i]) {
      free.push_back(static_cast<Eigen::Index>(i));
    }
  }
  const auto views = static_cast<double>(withoutOne.size());
  if (withoutOne.size() <= free.size() + 1) {
    return 1.0;
  }
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free.size()));
  for (const Eigen::VectorXd &parameters : withoutOne) {
    mean += parameters(free) / views;
  }
  double sum = 0.0;
  for (const Eigen::VectorXd &parameters : withoutOne) {
    const Eigen::VectorXd away = parameters(free) - mean;
    sum += away.dot(fit.bundle.information * away) / (fit.sigma * fit.sigma);
  }
  const double factor = (views - 1.0) / views * sum / static_cast<double>(free.size());
  return std::isfinite(factor) ? std::max(1.0, factor) : 1.0;
}

/** Fills in what the fit says about every view and about all of them. */
void describeViews(const BoardViews &views, const RobustFit &fit, const CalibrationOptions &options,
                   Calibration &result)
{
  double all = 0.0;
  double believed = 0.0;
  double heldout = 0.0;
  double heldoutPoints = 0.0;
  double points = 0.0;
  double inliers = 0.0;
  std::vector<Eigen::VectorXd> withoutOne;
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    CalibratedView view;
    view.cMo = fit.bundle.state.cMo[v];
    view.residuals = residuals(views.views[v], *fit.bundle.state.model, view.cMo);
    view.outliers = fit.inliers[v];
    view.outliers.flip();
    view.rms = rmsOf(view.residuals, fit.inliers[v]);
    const auto outliers =
        static_cast<int>(std::count(view.outliers.begin(), view.outliers.end(), true));
    const auto size = static_cast<double>(view.residuals.size());
    const double inside = size - outliers;
    const double rms = rmsOf(view.residuals, std::vector<bool>(view.residuals.size(), true));
    all += rms * rms * size;
    believed += view.rms * view.rms * inside;
    points += size;
    inliers += inside;
    result.outliers += outliers;
    if (options.crossValidate) {
      const LeftOut alone = leftOut(views, fit, v, result.estimated);
      if (std::isfinite(alone.rms)) {
        view.heldoutRms = alone.rms;
        heldout += alone.rms * alone.rms * inside;
        heldoutPoints += inside;
        withoutOne.push_back(alone.parameters);
      }
    }
    result.views.push_back(std::move(view));
  }
  result.rms = std::sqrt(all / points);
  result.robustRms = std::sqrt(believed / std::max(inliers, 1.0));
  if (heldoutPoints > 0.0) {
    result.heldoutRms = std::sqrt(heldout / heldoutPoints);
  }
  result.covariance *= spreadOverViews(withoutOne, fit, result.estimated);
}

Calibration calibrated(const BoardViews &given, const CameraModel *start,
                       const CalibrationOptions &options)
{
  const auto names = cameraModelNames();
  if (std::find(names.begin(), names.end(), options.model) == names.end()) {
    throw ConfigError("no camera model is called '" + options.model + "'");
  }
  const UsableViews usable = usableViews(given);
  const BoardViews &views = usable.views;
  Fitted best = fitted(views, usable.centre, start, options, false);
  if (usable.solid) {
    Fitted other = fitted(mirroredViews(views), usable.centre, start, options, true);
    if (other.fit.sigma < best.fit.sigma) {
      best = std::move(other);
    }
  }
  Calibration result;
  result.model = best.fit.bundle.state.model;
  result.estimated = best.estimated;
  result.warnings = usable.warnings;
  refuseImpossible(views, best.fit);
  result.covariance = covarianceOf(best.fit, result.estimated);
  const BoardViews seen = best.mirrored ? mirroredViews(views) : views;
  describeViews(seen, best.fit, options, result);
  result.mirrored = best.mirrored;
  addFindings(views, usable.solid, result);
  if (options.crossValidate) {
    addLonelyViews(views, result);
  }
  // Views without a say stand in the list too, empty-handed.
  for (const std::size_t v : usable.leftOut) {
    CalibratedView view;
    view.outliers.assign(given.views[v].pixels.size(), true);
    view.residuals.assign(given.views[v].pixels.size(), Eigen::Vector2d::Constant(NAN));
    result.views.insert(result.views.begin() + static_cast<std::ptrdiff_t>(v), std::move(view));
  }
  return result;
}

} // namespace

Eigen::MatrixXd Calibration::correlations() const
{
  const Eigen::VectorXd sigma = covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd scale =
      (sigma.array() > 0.0).select(sigma.cwiseMax(1e-300).cwiseInverse(), 0.0);
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

Calibration calibrate(const BoardViews &views, const CalibrationOptions &options)
{
  return calibrated(views, nullptr, options);
}

Calibration calibrateFromStart(const BoardViews &views, const CameraModel &start,
                               const CalibrationOptions &options)
{
  if (start.name() != "unified" || start.width() != views.width || start.height() != views.height) {
    throw LogicError("a calibration starts from the unified model of pictures of " +
                     std::to_string(views.width) + " x " + std::to_string(views.height) +
                     " pixels, not " + start.name() + " of " + std::to_string(start.width()) +
                     " x " + std::to_string(start.height()));
  }
  return calibrated(views, &start, options);
}

} // namespace homeward
