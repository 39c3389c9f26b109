// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/unified_camera.h>

#include <homeward/core/error.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{
namespace
{

using Parameters = UnifiedCamera::Parameters;

/** Distorted point of m, with d distorted / d m. */
struct Distorted
{
  Eigen::Vector2d d;
  Eigen::Matrix2d J_m;
};

Distorted distort(const Parameters &p, const Eigen::Vector2d &m)
{
  const double x = m.x();
  const double y = m.y();
  const double r2 = m.squaredNorm();
  const double radial = 1.0 + r2 * (p.k1 + p.k2 * r2);
  const double dRadial = 2.0 * (p.k1 + 2.0 * p.k2 * r2); // d radial / d x = x dRadial
  Distorted result;
  result.d = {x * radial + 2.0 * p.p1 * x * y + p.p2 * (r2 + 2.0 * x * x),
              y * radial + p.p1 * (r2 + 2.0 * y * y) + 2.0 * p.p2 * x * y};
  const double cross = x * y * dRadial + 2.0 * p.p1 * x + 2.0 * p.p2 * y;
  result.J_m << radial + x * x * dRadial + 2.0 * p.p1 * y + 6.0 * p.p2 * x, cross, cross,
      radial + y * y * dRadial + 6.0 * p.p1 * y + 2.0 * p.p2 * x;
  return result;
}

/** The radius up to which r (1 + k1 r^2 + k2 r^4) grows; infinite when it always does. */
double growingRadius(const Parameters &p)
{
  // Roots of 1 + 3 k1 s + 5 k2 s^2 with s = r^2.
  const double infinity = std::numeric_limits<double>::infinity();
  if (p.k2 == 0.0) {
    return p.k1 < 0.0 ? std::sqrt(-1.0 / (3.0 * p.k1)) : infinity;
  }
  const double discriminant = 9.0 * p.k1 * p.k1 - 20.0 * p.k2;
  if (discriminant < 0.0) {
    return infinity;
  }
  double smallest = infinity;
  for (const double sign : {-1.0, 1.0}) {
    const double root = (-3.0 * p.k1 + sign * std::sqrt(discriminant)) / (10.0 * p.k2);
    if (root > 0.0) {
      smallest = std::min(smallest, root);
    }
  }
  return std::sqrt(smallest);
}

/** Smallest z / |X| of the valid domain. */
double lowestZ(double xi)
{
  return xi <= 1.0 ? -xi : -1.0 / xi;
}

} // namespace

UnifiedCamera::UnifiedCamera(const Parameters &parameters, int width, int height)
    : m_parameters(parameters), m_width(width), m_height(height),
      m_largestRadius(growingRadius(parameters))
{
  const Parameters &p = parameters;
  const double sum = p.xi + p.fx + p.fy + p.cx + p.cy + p.k1 + p.k2 + p.p1 + p.p2 + p.skew;
  if (!std::isfinite(sum) || !(p.fx > 0.0) || !(p.fy > 0.0) || !(p.xi >= 0.0) || width <= 0 ||
      height <= 0) {
    throw LogicError("camera parameters out of range: xi " + std::to_string(p.xi) + ", fx " +
                     std::to_string(p.fx) + ", fy " + std::to_string(p.fy) + ", picture " +
                     std::to_string(width) + " x " + std::to_string(height) +
                     "; xi must not be negative, fx, fy and the size must be positive");
  }
}

std::optional<Eigen::Vector2d> UnifiedCamera::project(const Eigen::Vector3d &cX,
                                                      PointJacobian *J_point,
                                                      ParameterJacobian *J_parameters) const
{
  const Parameters &p = m_parameters;
  const double norm = cX.norm();
  const double depth = cX.z() + p.xi * norm;
  if (!(norm > 0.0) || !(cX.z() > lowestZ(p.xi) * norm) || !(depth > 1e-9 * norm)) {
    return std::nullopt;
  }
  const Eigen::Vector2d m = cX.head<2>() / depth;
  if (m.norm() >= m_largestRadius) {
    return std::nullopt;
  }
  const Distorted distorted = distort(p, m);
  Eigen::Matrix2d K;
  K << p.fx, p.skew, 0.0, p.fy;
  if (J_point != nullptr) {
    const Eigen::RowVector3d dDepth = Eigen::RowVector3d::UnitZ() + p.xi * cX.transpose() / norm;
    PointJacobian J_m = -m * dDepth;
    J_m.leftCols<2>() += Eigen::Matrix2d::Identity();
    *J_point = K * distorted.J_m * J_m / depth;
  }
  if (J_parameters != nullptr) {
    const double r2 = m.squaredNorm();
    const Eigen::Vector2d dXi = -m * (norm / depth);
    J_parameters->setZero();
    J_parameters->col(0) = K * distorted.J_m * dXi;
    (*J_parameters)(0, 1) = distorted.d.x();
    (*J_parameters)(1, 2) = distorted.d.y();
    (*J_parameters)(0, 3) = 1.0;
    (*J_parameters)(1, 4) = 1.0;
    J_parameters->col(5) = K * m * r2;
    J_parameters->col(6) = K * m * (r2 * r2);
    J_parameters->col(7) = K * Eigen::Vector2d(2.0 * m.x() * m.y(), r2 + 2.0 * m.y() * m.y());
    J_parameters->col(8) = K * Eigen::Vector2d(r2 + 2.0 * m.x() * m.x(), 2.0 * m.x() * m.y());
    (*J_parameters)(0, 9) = distorted.d.y();
  }
  return Eigen::Vector2d(K * distorted.d + Eigen::Vector2d(p.cx, p.cy));
}

std::optional<Eigen::Vector3d> UnifiedCamera::unproject(const Eigen::Vector2d &pixel) const
{
  const Parameters &p = m_parameters;
  const double dy = (pixel.y() - p.cy) / p.fy;
  const Eigen::Vector2d d((pixel.x() - p.cx - p.skew * dy) / p.fx, dy);
  constexpr int kIterations = 50;
  const double converged = 1e-14 * (1.0 + d.norm());
  const double accepted = 1e-10 * (1.0 + d.norm());
  // Newton, from inside the growing range.
  constexpr double kStart = 0.9;
  Eigen::Vector2d m =
      d.norm() < kStart * m_largestRadius ? d : d.normalized() * kStart * m_largestRadius;
  for (int i = 0; i < kIterations; ++i) {
    const Distorted distorted = distort(p, m);
    const Eigen::Vector2d residual = distorted.d - d;
    if (residual.norm() < converged) {
      break;
    }
    Eigen::Vector2d next = m - distorted.J_m.inverse() * residual;
    if (!(next.norm() < m_largestRadius)) {
      // It has left the growing range: go half the way to its border instead.
      next = 0.5 * (m + next.normalized() * m_largestRadius);
    }
    m = next;
  }
  if (!m.allFinite() || m.norm() >= m_largestRadius || (distort(p, m).d - d).norm() > accepted) {
    return std::nullopt;
  }
  const double r2 = m.squaredNorm();
  const double inside = 1.0 + (1.0 - p.xi * p.xi) * r2;
  if (inside < 0.0) {
    return std::nullopt;
  }
  const double scale = (p.xi + std::sqrt(inside)) / (1.0 + r2);
  const Eigen::Vector3d ray(scale * m.x(), scale * m.y(), scale - p.xi);
  if (!(ray.z() > lowestZ(p.xi))) {
    return std::nullopt;
  }
  return ray.normalized();
}

} // namespace homeward
