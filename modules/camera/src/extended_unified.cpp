// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/extended_unified.h>

#include <homeward/core/error.h>

#include <cmath>

namespace homeward
{

ExtendedUnified::ExtendedUnified(const Eigen::VectorXd &parameters, int width, int height)
    : FocalModel(parameters, 2, width, height)
{
  if (!(shape(0) >= 0.0 && shape(0) <= 1.0) || !(shape(1) > 0.0)) {
    throw LogicError("alpha must be from 0 to 1 and beta positive, not " +
                     std::to_string(shape(0)) + " and " + std::to_string(shape(1)));
  }
}

std::unique_ptr<CameraModel> ExtendedUnified::with(const Eigen::VectorXd &parameters) const
{
  return std::make_unique<ExtendedUnified>(parameters, width(), height());
}

std::optional<FocalModel::Normalized> ExtendedUnified::normalize(const Eigen::Vector3d &cX) const
{
  const double alpha = shape(0);
  const double beta = shape(1);
  const double z = cX.z();
  const double r2 = cX.head<2>().squaredNorm();
  const double d = std::sqrt(beta * r2 + z * z);
  const double n = alpha * d + (1.0 - alpha) * z;
  const double w = alpha <= 0.5 ? alpha / (1.0 - alpha) : (1.0 - alpha) / alpha;
  if (!(z > -w * d) || !(n > 1e-9 * d)) {
    return std::nullopt;
  }
  const Eigen::RowVector3d dPoint(alpha * beta * cX.x() / d, alpha * beta * cX.y() / d,
                                  alpha * z / d + 1.0 - alpha);
  return divided(cX, n, dPoint, {d - z, alpha * r2 / (2.0 * d)});
}

std::optional<Eigen::Vector3d> ExtendedUnified::direction(const Eigen::Vector2d &m) const
{
  const double alpha = shape(0);
  const double beta = shape(1);
  const double r2 = m.squaredNorm();
  const double inside = 1.0 - (2.0 * alpha - 1.0) * beta * r2;
  if (!(inside > 0.0)) {
    return std::nullopt;
  }
  const double z = (1.0 - beta * alpha * alpha * r2) / (alpha * std::sqrt(inside) + 1.0 - alpha);
  return Eigen::Vector3d(m.x(), m.y(), z);
}

} // namespace homeward
