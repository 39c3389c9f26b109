// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/double_sphere.h>

#include <homeward/core/error.h>

#include <cmath>

namespace homeward
{

DoubleSphere::DoubleSphere(const Eigen::VectorXd &parameters, int width, int height)
    : FocalModel(parameters, 2, width, height)
{
  const double xi = shape(0);
  const double alpha = shape(1);
  if (!(xi > -1.0 && xi <= 1.0) || !(alpha >= 0.0 && alpha <= 1.0)) {
    throw LogicError("xi must be over -1 and at most 1, alpha from 0 to 1, not " +
                     std::to_string(xi) + " and " + std::to_string(alpha));
  }
}

std::unique_ptr<CameraModel> DoubleSphere::with(const Eigen::VectorXd &parameters) const
{
  return std::make_unique<DoubleSphere>(parameters, width(), height());
}

std::optional<FocalModel::Normalized> DoubleSphere::normalize(const Eigen::Vector3d &cX) const
{
  const double xi = shape(0);
  const double alpha = shape(1);
  const double d1 = cX.norm();
  const double s = xi * d1 + cX.z();
  const double d2 = std::sqrt(cX.head<2>().squaredNorm() + s * s);
  const double n = alpha * d2 + (1.0 - alpha) * s;
  const double w = alpha <= 0.5 ? alpha / (1.0 - alpha) : (1.0 - alpha) / alpha;
  if (!(s > -w * d2) || !(n > 1e-9 * d1)) {
    return std::nullopt;
  }
  const Eigen::RowVector3d dS = xi * cX.transpose() / d1 + Eigen::RowVector3d::UnitZ();
  const Eigen::RowVector3d dD2 = (Eigen::RowVector3d(cX.x(), cX.y(), 0.0) + s * dS) / d2;
  return divided(cX, n, alpha * dD2 + (1.0 - alpha) * dS,
                 {alpha * s * d1 / d2 + (1.0 - alpha) * d1, d2 - s});
}

std::optional<Eigen::Vector3d> DoubleSphere::direction(const Eigen::Vector2d &m) const
{
  const double xi = shape(0);
  const double alpha = shape(1);
  const double r2 = m.squaredNorm();
  const double inside = 1.0 - (2.0 * alpha - 1.0) * r2;
  if (!(inside > 0.0)) {
    return std::nullopt;
  }
  const double z = (1.0 - alpha * alpha * r2) / (alpha * std::sqrt(inside) + 1.0 - alpha);
  const double scale = (z * xi + std::sqrt(z * z + (1.0 - xi * xi) * r2)) / (z * z + r2);
  return Eigen::Vector3d(scale * m.x(), scale * m.y(), scale * z - xi);
}

} // namespace homeward
