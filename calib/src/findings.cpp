// SPDX-License-Identifier: GPL-3.0-or-later
#include "findings.h"

#include <homeward/calib/radial_start.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/core/symmetric_eigen.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace homeward
{
namespace
{

constexpr std::size_t kFewestViews = 3;

std::string rounded(double value, int digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string nameOf(const BoardView &view, std::size_t index)
{
  return view.name.empty() ? "view " + std::to_string(index) : view.name;
}

void checkNumbers(const BoardView &view, std::size_t index)
{
  if (view.board.size() != view.pixels.size()) {
    throw LogicError(nameOf(view, index) + " has " + std::to_string(view.board.size()) +
                     " points and " + std::to_string(view.pixels.size()) + " pixels");
  }
  for (std::size_t i = 0; i < view.board.size(); ++i) {
    if (!view.board[i].allFinite() || !view.pixels[i].allFinite()) {
      throw LogicError(nameOf(view, index) + ", point " + std::to_string(i) + " is no number");
    }
  }
}

bool isSolid(const BoardView &view)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d &point : view.board) {
    mean += point / static_cast<double>(view.board.size());
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d &point : view.board) {
    scatter += (point - mean) * (point - mean).transpose();
  }
  const Eigen::VectorXd spread = symmetricEigen(scatter).values;
  constexpr double kFlat = 1e-4; // squared, of the longest
  return spread[0] > kFlat * spread[2];
}

/** How the target is turned and where it is, compared. */
bool alike(const Eigen::Isometry3d &a, const Eigen::Isometry3d &b, const Eigen::Vector3d &middle)
{
  constexpr double kTurn = 3.0; // degrees
  constexpr double kWay = 0.05; // of the distance
  const double turn = Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
  const Eigen::Vector3d seenA = a * middle;
  const Eigen::Vector3d seenB = b * middle;
  return turn < radians(kTurn) && (seenA - seenB).norm() < kWay * seenA.norm();
}

Eigen::Vector3d middleOf(const BoardView &view)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d &point : view.board) {
    mean += point / static_cast<double>(view.board.size());
  }
  return mean;
}

/** Which side of the flat targets is seen: mirrored when it is the back. */
void addHandedness(const BoardViews &views, Calibration &calibration)
{
  std::vector<std::size_t> fronts;
  std::vector<std::size_t> backs;
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    const Eigen::Isometry3d &cMo = calibration.views[v].cMo;
    const double side = cMo.linear().col(2).dot(cMo * middleOf(views.views[v]));
    (side > 0.0 ? fronts : backs).push_back(v);
  }
  calibration.mirrored = backs.size() > fronts.size();
  const auto &odd = calibration.mirrored ? fronts : backs;
  if (!odd.empty()) {
    std::string names;
    for (const std::size_t v : odd) {
      names += (names.empty() ? "" : ", ") + nameOf(views.views[v], v);
    }
    calibration.warnings.push_back(
        "the target's points run the other way round in " + names +
        " than in the rest: they are numbered mirror-wise there; a flat target fits all the same, "
        "but these poses show its back");
  }
}

void addCoverage(const BoardViews &views, Calibration &calibration)
{
  const auto centre = calibration.model->project(Eigen::Vector3d::UnitZ());
  if (!centre) {
    return;
  }
  constexpr int kSectors = 12;
  std::vector<bool> seen(kSectors, false);
  double farthest = 0.0;
  for (const BoardView &view : views.views) {
    for (const Eigen::Vector2d &pixel : view.pixels) {
      const Eigen::Vector2d m = pixel - *centre;
      farthest = std::max(farthest, m.norm());
      const double turn = (std::atan2(m.y(), m.x()) + kPi) / (2.0 * kPi);
      seen[static_cast<std::size_t>(turn * kSectors) % kSectors] = true;
    }
  }
  const double rim = 0.5 * std::min(views.width, views.height);
  constexpr double kNear = 0.75;
  if (farthest < kNear * rim) {
    calibration.warnings.push_back(
        "no view near the rim: the farthest point is " + rounded(farthest, 0) +
        " pixels from the centre, the picture reaches " + rounded(rim, 0) +
        "; take views with the target high up and near");
  }
  int longest = 0;
  int run = 0;
  for (int i = 0; i < 2 * kSectors; ++i) {
    run = seen[static_cast<std::size_t>(i % kSectors)] ? 0 : run + 1;
    longest = std::max(longest, std::min(run, kSectors));
  }
  constexpr int kGap = 4; // 120 degrees
  if (longest >= kGap) {
    calibration.warnings.push_back("no view over " + std::to_string(longest * 360 / kSectors) +
                                   " degrees of the turn: take views all round the mirror");
  }
}

void addUncertainty(Calibration &calibration)
{
  const auto names = calibration.model->parameterNames();
  const Eigen::VectorXd values = calibration.model->parameters();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double sigma = std::sqrt(calibration.covariance(at, at));
    const bool length = names[i] == "fx" || names[i] == "fy" || names[i] == "a0";
    const bool centre = names[i] == "cx" || names[i] == "cy";
    constexpr double kLoose = 0.02; // of the focal length
    constexpr double kOpen = 0.1;   // likewise
    if (length && !(sigma < kOpen * std::abs(values[at]))) {
      throw ConfigError("the views do not tell the camera: " + names[i] + " " +
                        rounded(values[at], 2) + " +- " + rounded(sigma, 2) +
                        " pixels; check --target, --columns, --rows and the measures, or hold the "
                        "target nearer, tilted and all round");
    }
    constexpr double kCentre = 2.0; // pixels
    if ((length && sigma > kLoose * std::abs(values[at])) || (centre && sigma > kCentre)) {
      calibration.warnings.push_back(
          "the views leave " + names[i] + " open: " + rounded(values[at], 2) + " +- " +
          rounded(sigma, 2) + " pixels; add views, nearer, tilted and all round");
    }
  }
}

/** What is right has points that lie where the camera shows them, nearly all. */
void addFit(const BoardViews &views, Calibration &calibration)
{
  std::size_t points = 0;
  for (const BoardView &view : views.views) {
    points += view.pixels.size();
  }
  constexpr double kMany = 0.1;      // of the points
  constexpr double kRough = 0.00045; // of the picture's width
  if (static_cast<double>(calibration.outliers) > kMany * static_cast<double>(points)) {
    calibration.warnings.push_back(
        std::to_string(calibration.outliers) + " of " + std::to_string(points) +
        " points were not believed: do all pictures come from one camera with a fixed focus, none "
        "turned, and is the target flat?");
  }
  if (calibration.robustRms > kRough * views.width) {
    calibration.warnings.push_back(
        "points lie " + rounded(calibration.robustRms, 2) +
        " pixels from where the camera shows them, a tenth is usual in sharp pictures: check the "
        "target's measures (tags and markers, too), that it is flat, and the focus");
  }
}

void addMirror(Calibration &calibration)
{
  if (calibration.model->name() != "unified") {
    return;
  }
  const double xi = calibration.model->parameters()[0];
  const double sigma = std::sqrt(calibration.covariance(0, 0));
  constexpr double kSure = 3.0;
  constexpr double kFlattest = 0.3;
  if (xi > 0.0 && xi <= 1.0) {
    calibration.mirrorEccentricity = (1.0 + std::sqrt(1.0 - xi * xi)) / xi;
  }
  if (xi - kSure * sigma > 1.0) {
    calibration.warnings.push_back(
        "xi " + rounded(xi, 3) + " +- " + rounded(sigma, 3) +
        " is more than 1, which no mirror with one focus has: the camera stands out of the "
        "mirror's second focus, or this is a fish-eye; the model still describes the picture");
  }
  else if (xi + kSure * sigma < kFlattest) {
    calibration.warnings.push_back("xi " + rounded(xi, 3) + " +- " + rounded(sigma, 3) +
                                   " is that of a lens, not of a mirror seen from its focus");
  }
}

} // namespace

UsableViews usableViews(const BoardViews &views)
{
  UsableViews usable;
  usable.views.width = views.width;
  usable.views.height = views.height;
  if (views.width <= 0 || views.height <= 0) {
    throw LogicError("pictures of " + std::to_string(views.width) + " x " +
                     std::to_string(views.height) + " pixels cannot be calibrated");
  }
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    checkNumbers(views.views[v], v);
  }
  BoardViews shaped = usable.views;
  std::vector<std::size_t> origin;
  const Eigen::Vector2d middle(0.5 * views.width, 0.5 * views.height);
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    if (radialPose(views.views[v], middle)) {
      shaped.views.push_back(views.views[v]);
      origin.push_back(v);
      usable.solid = usable.solid || isSolid(views.views[v]);
    }
    else {
      usable.leftOut.push_back(v);
      usable.warnings.push_back(nameOf(views.views[v], v) +
                                " is left out: fewer than six points, or all on a line");
    }
  }
  if (shaped.views.size() < kFewestViews) {
    throw ConfigError(std::to_string(shaped.views.size()) + " of " +
                      std::to_string(views.views.size()) +
                      " views show a target with six points or more, and a calibration needs at "
                      "least three: take ten or more, tilted in different ways and all round");
  }
  usable.centre = radialCentre(shaped);
  std::vector<double> errors;
  for (const BoardView &view : shaped.views) {
    errors.push_back(radialPose(view, usable.centre)->rms);
  }
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  constexpr double kFarOff = 10.0;  // times the median
  constexpr double kPixels = 0.005; // of the picture's width
  const double limit = std::max(kFarOff * sorted[sorted.size() / 2], kPixels * views.width);
  for (std::size_t i = 0; i < shaped.views.size(); ++i) {
    if (errors[i] <= limit) {
      usable.views.views.push_back(shaped.views[i]);
      continue;
    }
    usable.leftOut.push_back(origin[i]);
    usable.warnings.push_back(nameOf(shaped.views[i], origin[i]) +
                              " is left out: no pose of the target explains it (" +
                              rounded(errors[i], 1) +
                              " pixels); check the order of its points and the target's measures");
  }
  std::sort(usable.leftOut.begin(), usable.leftOut.end());
  if (usable.views.views.size() < kFewestViews) {
    throw ConfigError("only " + std::to_string(usable.views.views.size()) +
                      " views agree on a camera: check the order of the points and the target's "
                      "measures");
  }
  return usable;
}

void refuseImpossible(const BoardViews &views, const RobustFit &fit)
{
  const BundleState &state = fit.bundle.state;
  constexpr double kHopeless = 0.005; // of the picture's width
  std::size_t points = 0;
  std::size_t believed = 0;
  for (const auto &view : fit.inliers) {
    points += view.size();
    believed += static_cast<std::size_t>(std::count(view.begin(), view.end(), true));
  }
  if (!std::isfinite(fit.sigma) || fit.sigma > kHopeless * views.width || 2 * believed < points) {
    throw ConfigError("no camera explains these views (" + std::to_string(points - believed) +
                      " of " + std::to_string(points) + " points are off, the rest by " +
                      rounded(fit.sigma, 1) +
                      " pixels): check the target's measures, the order of its points and whether "
                      "all pictures come from one camera with a fixed focus");
  }
  const Eigen::Vector3d middle = middleOf(views.views[0]);
  const bool allAlike =
      std::all_of(state.cMo.begin(), state.cMo.end(),
                  [&](const Eigen::Isometry3d &cMo) { return alike(state.cMo[0], cMo, middle); });
  if (allAlike) {
    throw ConfigError("all " + std::to_string(views.views.size()) +
                      " views are alike: move the target round the mirror and tilt it in "
                      "different ways, then take them again");
  }
}

void addFindings(const BoardViews &views, bool solid, Calibration &calibration)
{
  if (!solid) {
    addHandedness(views, calibration);
  }
  addCoverage(views, calibration);
  addUncertainty(calibration);
  addFit(views, calibration);
  addMirror(calibration);
}

void addLonelyViews(const BoardViews &views, Calibration &calibration)
{
  constexpr double kFarOff = 3.0;
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    const CalibratedView &view = calibration.views[v];
    if (!view.heldoutRms || *view.heldoutRms > kFarOff * calibration.robustRms) {
      calibration.warnings.push_back("the camera rests on " + nameOf(views.views[v], v) +
                                     " alone where that view lies: left out, it is " +
                                     (view.heldoutRms
                                          ? "off by " + rounded(*view.heldoutRms, 1) + " pixels"
                                          : std::string("not to be seen at all")) +
                                     "; take more views there");
    }
  }
}

} // namespace homeward
