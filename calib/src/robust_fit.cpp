// SPDX-License-Identifier: GPL-3.0-or-later
#include "robust_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

constexpr double kFiveScales = 5.0; // where Tukey's weight is zero
constexpr double kFinest = 1e-4;    // pixels; noise-free points have no scale

PointMask within(const std::vector<BoardView> &views, const BundleState &state, double limit)
{
  PointMask mask = everyPoint(views);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto errors = residuals(views[v], *state.model, state.cMo[v]);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      mask[v][i] = errors[i].norm() <= limit; // never for NaN
    }
  }
  return mask;
}

std::size_t count(const PointMask &mask)
{
  std::size_t sum = 0;
  for (const auto &view : mask) {
    sum += static_cast<std::size_t>(std::count(view.begin(), view.end(), true));
  }
  return sum;
}

} // namespace

PointMask everyPoint(const std::vector<BoardView> &views)
{
  PointMask mask;
  for (const BoardView &view : views) {
    mask.emplace_back(view.pixels.size(), true);
  }
  return mask;
}

double robustScale(const std::vector<BoardView> &views, const PointMask &mask,
                   const BundleState &state)
{
  std::vector<double> lengths;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto errors = residuals(views[v], *state.model, state.cMo[v]);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (mask[v][i]) {
        const double length = errors[i].norm();
        lengths.push_back(std::isnan(length) ? std::numeric_limits<double>::max() : length);
      }
    }
  }
  if (lengths.empty()) {
    return kFinest;
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  constexpr double kRayleighMedian = 1.17741;
  return std::clamp(*middle / kRayleighMedian, kFinest, 1e4);
}

RobustFit fitRobustly(const std::vector<BoardView> &views, const BundleState &start,
                      const std::vector<bool> &estimated)
{
  constexpr int kRounds = 10;
  const PointMask all = everyPoint(views);
  RobustFit fit;
  BundleOptions options;
  options.estimated = estimated;
  options.still = 1e-7;
  BundleState state = start;
  options.scale = robustScale(views, all, state);
  for (int round = 0; round < kRounds; ++round) {
    options.loss = round == 0 ? Loss::Huber : Loss::Tukey;
    state = adjustBundle(views, all, state, options).state;
    const double next = robustScale(views, all, state);
    const bool rests = round > 0 && std::abs(next - options.scale) < 0.01 * options.scale;
    options.scale = next;
    if (rests) {
      break;
    }
  }
  options.loss = Loss::Squares;
  options.still = BundleOptions().still;
  fit.inliers = within(views, state, kFiveScales * options.scale);
  const auto free = static_cast<double>(std::count(estimated.begin(), estimated.end(), true)) +
                    6.0 * static_cast<double>(views.size());
  for (int round = 0; round < kRounds; ++round) {
    fit.bundle = adjustBundle(views, fit.inliers, state, options);
    state = fit.bundle.state;
    const double spare = 2.0 * static_cast<double>(count(fit.inliers)) - free;
    fit.sigma = std::sqrt(fit.bundle.cost / std::max(spare, 1.0));
    PointMask next = within(views, state, kFiveScales * std::max(fit.sigma, kFinest));
    if (next == fit.inliers) {
      break;
    }
    fit.inliers = std::move(next);
  }
  return fit;
}

double rmsOf(const std::vector<Eigen::Vector2d> &residuals, const std::vector<bool> &mask)
{
  double sum = 0.0;
  int points = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (mask[i]) {
      ++points;
      sum += std::isnan(residuals[i].x()) ? std::numeric_limits<double>::infinity()
                                          : residuals[i].squaredNorm();
    }
  }
  return std::sqrt(sum / std::max(points, 1));
}

} // namespace homeward
