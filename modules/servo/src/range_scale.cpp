// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/range_scale.h>

#include <homeward/core/angle.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace homeward
{

void RangeScale::add(const Eigen::Vector2d &oMirror, double oBearing, double proxy, double weight)
{
  constexpr std::size_t kViews = 30;
  constexpr double kMoved = 0.08; // metres: views from one place tell nothing but their noise
  constexpr double kNear = 0.5;   // proxies beyond grow more slowly than the distance
  if (proxy > kNear || weight <= 0.0) {
    return;
  }
  if (!m_views.empty() && (m_views.back().oMirror - oMirror).norm() < kMoved) {
    return;
  }
  m_views.push_back({oMirror, oBearing, proxy, weight});
  if (m_views.size() > kViews) {
    m_views.pop_front();
  }
  solve();
}

void RangeScale::solve()
{
  constexpr double kBearingSigma = radians(4.0);
  constexpr double kProxySigma = 0.15; // of the range
  constexpr double kLeastSigma = 0.02; // metres
  constexpr double kGuessSigma = 1.0;  // of the guess
  const double within[] = {0.25 * m_guess, 4.0 * m_guess};
  // Unknowns: place of home (x, y) against the last view's, scale.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto take = [&](const Eigen::Vector3d &row, double value, double sigma, double weight) {
    normal += weight / (sigma * sigma) * row * row.transpose();
    right += weight / (sigma * sigma) * value * row;
  };
  take({0.0, 0.0, 1.0}, m_guess, kGuessSigma * m_guess, 1.0);
  for (const View &view : m_views) {
    const double range = m_scale * view.proxy;
    const Eigen::Vector2d along(std::cos(view.oBearing), std::sin(view.oBearing));
    const Eigen::Vector2d across(-along.y(), along.x());
    const Eigen::Vector2d here = view.oMirror - m_views.back().oMirror;
    take({across.x(), across.y(), 0.0}, across.dot(here), kBearingSigma * range + kLeastSigma,
         view.weight);
    take({along.x(), along.y(), -view.proxy}, along.dot(here), kProxySigma * range + kLeastSigma,
         view.weight);
  }
  m_scale = std::clamp(normal.ldlt().solve(right).z(), within[0], within[1]);
}

} // namespace homeward
