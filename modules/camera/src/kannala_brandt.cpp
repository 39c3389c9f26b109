// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/kannala_brandt.h>

#include "root.h"

#include <homeward/core/angle.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

KannalaBrandt::KannalaBrandt(const Eigen::VectorXd &parameters, int width, int height)
    : FocalModel(parameters, 4, width, height),
      m_largestAngle(firstRoot(kPi, [this](double angle) { return slope(angle); }))
{}

double KannalaBrandt::distorted(double angle) const
{
  const double s = angle * angle;
  return angle * (1.0 + s * (shape(0) + s * (shape(1) + s * (shape(2) + s * shape(3)))));
}

double KannalaBrandt::slope(double angle) const
{
  const double s = angle * angle;
  return 1.0 +
         s * (3.0 * shape(0) + s * (5.0 * shape(1) + s * (7.0 * shape(2) + s * 9.0 * shape(3))));
}

std::unique_ptr<CameraModel> KannalaBrandt::with(const Eigen::VectorXd &parameters) const
{
  return std::make_unique<KannalaBrandt>(parameters, width(), height());
}

std::optional<FocalModel::Normalized> KannalaBrandt::normalize(const Eigen::Vector3d &cX) const
{
  const Eigen::Vector2d xy = cX.head<2>();
  const double r = xy.norm();
  const double angle = std::atan2(r, cX.z());
  if (!(angle < m_largestAngle)) {
    return std::nullopt;
  }
  const double grows = slope(angle);
  const double length2 = cX.squaredNorm();
  const bool onAxis = r < 1e-12 * cX.z();
  const double scale = onAxis ? 1.0 / cX.z() : distorted(angle) / r;
  Normalized result;
  result.m = scale * xy;
  result.J_point.leftCols<2>() = scale * Eigen::Matrix2d::Identity();
  if (!onAxis) {
    const double dScale = (grows * cX.z() / length2 - scale) / r; // d scale / d r
    result.J_point.leftCols<2>() += xy * xy.transpose() * (dScale / r);
  }
  result.J_point.col(2) = -xy * (grows / length2);
  result.J_shape.setZero(2, 4);
  if (!onAxis) {
    double power = angle * angle * angle / r;
    for (int i = 0; i < 4; ++i, power *= angle * angle) {
      result.J_shape.col(i) = power * xy;
    }
  }
  return result;
}

std::optional<Eigen::Vector3d> KannalaBrandt::direction(const Eigen::Vector2d &m) const
{
  const double d = m.norm();
  if (!(d < distorted(m_largestAngle))) {
    return std::nullopt;
  }
  if (d == 0.0) {
    return Eigen::Vector3d::UnitZ();
  }
  const double angle = rootBetween(
      0.0, m_largestAngle, std::min(d, 0.9 * m_largestAngle),
      [&](double t) { return distorted(t) - d; }, [this](double t) { return slope(t); });
  if (!(angle < m_largestAngle)) {
    return std::nullopt;
  }
  const Eigen::Vector2d xy = std::sin(angle) * m / d;
  return Eigen::Vector3d(xy.x(), xy.y(), std::cos(angle));
}

} // namespace homeward
