// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/ocam.h>

#include "root.h"

#include <homeward/core/error.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homeward
{

Ocam::Ocam(const Eigen::VectorXd &parameters, int width, int height)
    : m_parameters(parameters), m_terms(parameters.size() - kAffine), m_width(width),
      m_height(height)
{
  constexpr Eigen::Index kMostTerms = 8;
  if (m_terms < 2 || m_terms > kMostTerms) {
    throw LogicError("the ocam model has 7 to 13 parameters, not " +
                     std::to_string(parameters.size()));
  }
  const Eigen::VectorXd affine = parameters.tail(kAffine);
  m_affine << 1.0, affine[2], affine[1], affine[0];
  if (!parameters.allFinite() || !(parameters[0] > 0.0) || !(m_affine.determinant() > 0.0) ||
      width <= 0 || height <= 0) {
    throw LogicError("camera parameters out of range: a0 " + std::to_string(parameters[0]) +
                     ", c " + std::to_string(affine[0]) + ", picture " + std::to_string(width) +
                     " x " + std::to_string(height) +
                     "; all must be finite, a0, c and the size positive");
  }
  // The angle's cotangent, height(r) / r, falls as long as this is positive.
  m_largestRadius =
      firstRoot(1.0 * width + height, [this](double r) { return this->height(r) - r * slope(r); });
}

double Ocam::height(double r) const
{
  double sum = 0.0;
  for (Eigen::Index i = m_terms; i-- > 1;) {
    sum = (sum + m_parameters[i]) * r;
  }
  return sum * r + m_parameters[0];
}

double Ocam::slope(double r) const
{
  double sum = 0.0;
  for (Eigen::Index i = m_terms; i-- > 1;) {
    sum = (sum + static_cast<double>(i + 1) * m_parameters[i]) * r;
  }
  return sum;
}

std::vector<std::string> Ocam::parameterNames() const
{
  std::vector<std::string> names{"a0"};
  for (Eigen::Index i = 1; i < m_terms; ++i) {
    names.emplace_back(1, 'a').append(std::to_string(i + 1));
  }
  names.insert(names.end(), {"c", "d", "e", "cx", "cy"});
  return names;
}

std::unique_ptr<CameraModel> Ocam::with(const Eigen::VectorXd &parameters) const
{
  return std::make_unique<Ocam>(parameters, m_width, m_height);
}

std::optional<double> Ocam::radius(double across, double z) const
{
  const double end = m_largestRadius;
  // r z - across height(r): negative at 0, and it has one root while the cotangent falls.
  if (!(end * z - across * height(end) > 0.0)) {
    return std::nullopt;
  }
  const double start = z > 0.0 ? std::min(m_parameters[0] * across / z, 0.5 * end) : 0.5 * end;
  const double r = rootBetween(
      0.0, end, start, [&](double x) { return x * z - across * height(x); },
      [&](double x) { return z - across * slope(x); });
  return r < end ? std::optional(r) : std::nullopt;
}

std::optional<Eigen::Vector2d> Ocam::project(const Eigen::Vector3d &cX, PointJacobian *J_point,
                                             ParameterJacobian *J_parameters) const
{
  const double length = cX.norm();
  if (!(length > 0.0) || !cX.allFinite()) {
    return std::nullopt;
  }
  const Eigen::Vector2d xy = cX.head<2>();
  const double across = xy.norm();
  const double z = cX.z();
  const bool onAxis = across < 1e-12 * length;
  if (onAxis && !(z > 0.0)) {
    return std::nullopt;
  }
  const auto r = onAxis ? std::optional(m_parameters[0] * across / z) : radius(across, z);
  if (!r) {
    return std::nullopt;
  }
  // m = scale xy, and g(r) = across height(r) - r z = 0 moves r.
  const double scale = onAxis ? m_parameters[0] / z : *r / across;
  const Eigen::Vector2d m = scale * xy;
  const Eigen::Vector2d along = onAxis ? Eigen::Vector2d::Zero() : Eigen::Vector2d(xy / across);
  const double fall = z - across * slope(*r); // -dg / dr
  if (J_point != nullptr) {
    PointJacobian J_m;
    J_m.leftCols<2>() = scale * Eigen::Matrix2d::Identity() +
                        along * along.transpose() * (height(*r) / fall - scale);
    J_m.col(2) = -along * (*r / fall);
    *J_point = m_affine * J_m;
  }
  if (J_parameters != nullptr) {
    J_parameters->setZero(2, m_parameters.size());
    double power = across / fall;
    for (Eigen::Index i = 0; i < m_terms; ++i) {
      J_parameters->col(i) = m_affine * along * power;
      power *= i == 0 ? *r * *r : *r;
    }
    (*J_parameters)(1, m_terms) = m.y();
    (*J_parameters)(1, m_terms + 1) = m.x();
    (*J_parameters)(0, m_terms + 2) = m.y();
    J_parameters->rightCols<2>().setIdentity();
  }
  return Eigen::Vector2d(m_affine * m + m_parameters.tail<2>());
}

std::optional<Eigen::Vector3d> Ocam::unproject(const Eigen::Vector2d &pixel) const
{
  const Eigen::Vector2d m = m_affine.inverse() * (pixel - m_parameters.tail<2>());
  const double r = m.norm();
  if (!(r < m_largestRadius)) {
    return std::nullopt;
  }
  return Eigen::Vector3d(m.x(), m.y(), height(r)).normalized();
}

} // namespace homeward
