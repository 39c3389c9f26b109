// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/convert.h>

#include <homeward/calib/bundle.h>
#include <homeward/camera/camera_models.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

/** The target with the source's centre and its scale at the centre, and a shape in the middle. */
std::unique_ptr<CameraModel> firstGuess(const CameraModel &source, const std::string &target)
{
  CameraModel::PointJacobian J_point;
  const auto centre = source.project(Eigen::Vector3d::UnitZ(), &J_point);
  if (!centre) {
    throw ConfigError("the " + source.name() + " model does not see along its axis");
  }
  const double fx = std::abs(J_point(0, 0));
  const double fy = std::abs(J_point(1, 1));
  Eigen::VectorXd p;
  if (target == "unified") {
    p.setZero(10);
    p.head<5>() << 1.0, 2.0 * fx, 2.0 * fy, *centre;
  }
  else if (target == "extended_unified") {
    p.resize(6);
    p << 0.5, 1.0, fx, fy, *centre;
  }
  else if (target == "double_sphere") {
    p.resize(6);
    p << 0.9, 0.1, 1.9 * fx, 1.9 * fy, *centre;
  }
  else if (target == "kannala_brandt") {
    p.setZero(8);
    p.tail<4>() << fx, fy, *centre;
  }
  else if (target == "ocam") {
    p.setZero(9);
    p.head<2>() << fx, -0.25 / fx;
    p[4] = fy / fx;
    p.tail<2>() = *centre;
  }
  else {
    std::string names;
    for (const std::string &name : cameraModelNames()) {
      names += (names.empty() ? "" : ", ") + name;
    }
    throw ConfigError("no camera model is called '" + target + "'; there are " + names);
  }
  return makeCameraModel(target, p, source.width(), source.height());
}

} // namespace

std::vector<bool> freeParameters(const CameraModel &model, bool distortion)
{
  const std::vector<std::string> names = model.parameterNames();
  std::vector<bool> free(names.size(), true);
  const bool held = !distortion;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string &name = names[i];
    if (model.name() == "ocam") {
      // A turn round the axis is d = -e: the poses have it already.
      free[i] = name != "e" && !(held && (name == "c" || name == "d"));
    }
    else if (name == "skew" || name.front() == 'k' || name.front() == 'p') {
      free[i] = !held;
    }
  }
  return free;
}

std::vector<Eigen::Vector2d> pixelGrid(const CameraModel &model, double inner, double outer)
{
  constexpr int kSteps = 40;
  std::vector<Eigen::Vector2d> pixels;
  const Eigen::Vector2d middle(0.5 * model.width(), 0.5 * model.height());
  const Eigen::Vector2d centre = model.project(Eigen::Vector3d::UnitZ()).value_or(middle);
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const Eigen::Vector2d pixel((model.width() - 1.0) * column / kSteps,
                                  (model.height() - 1.0) * row / kSteps);
      const double radius = (pixel - centre).norm();
      if (radius >= inner && radius <= outer) {
        pixels.push_back(pixel);
      }
    }
  }
  return pixels;
}

ModelFit fitModel(const CameraModel &source, const std::string &target,
                  const std::vector<Eigen::Vector2d> &pixels, bool distortion)
{
  BundleState state{firstGuess(source, target), {Eigen::Isometry3d::Identity()}};
  BoardView rays;
  std::vector<bool> steep;
  for (const Eigen::Vector2d &pixel : pixels) {
    if (const auto ray = source.unproject(pixel)) {
      rays.board.push_back(*ray);
      rays.pixels.push_back(pixel);
      steep.push_back(ray->z() < 0.2);
    }
  }
  constexpr std::size_t kFewest = 20;
  if (rays.pixels.size() < kFewest) {
    throw ConfigError("the " + source.name() + " model sees only " +
                      std::to_string(rays.pixels.size()) +
                      " of the given pixels; its parameters do not suit the picture's size");
  }
  // First what every first guess sees, then everything.
  BundleOptions options;
  options.estimated = freeParameters(*state.model, distortion);
  if (target == "ocam" && distortion) {
    std::fill(options.estimated.begin(), options.estimated.end(), true);
  }
  options.holdPoses = true;
  std::vector<bool> flat = steep;
  flat.flip();
  if (static_cast<std::size_t>(std::count(flat.begin(), flat.end(), true)) >= kFewest) {
    BundleOptions few = options;
    few.estimated = freeParameters(*state.model, false);
    state = adjustBundle({rays}, {flat}, state, few).state;
  }
  const std::vector<bool> all(rays.pixels.size(), true);
  state = adjustBundle({rays}, {all}, state, options).state;

  ModelFit fit;
  fit.model = state.model;
  int seen = 0;
  for (const Eigen::Vector2d &residual : residuals(rays, *state.model, state.cMo[0])) {
    if (residual.allFinite()) {
      ++seen;
      fit.mean += residual.norm();
      fit.largest = std::max(fit.largest, residual.norm());
    }
  }
  fit.mean /= std::max(seen, 1);
  fit.unseen = 1.0 - static_cast<double>(seen) / static_cast<double>(rays.pixels.size());
  return fit;
}

} // namespace homeward
