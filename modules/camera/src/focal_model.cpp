// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/focal_model.h>

#include <homeward/core/error.h>

namespace homeward
{

FocalModel::FocalModel(const Eigen::VectorXd &parameters, int shapes, int width, int height)
    : m_parameters(parameters), m_shapes(shapes), m_width(width), m_height(height)
{
  if (parameters.size() != shapes + 4) {
    throw LogicError("this camera model has " + std::to_string(shapes + 4) + " parameters, not " +
                     std::to_string(parameters.size()));
  }
  const double fx = parameters[shapes];
  const double fy = parameters[shapes + 1];
  if (!parameters.allFinite() || !(fx > 0.0) || !(fy > 0.0) || width <= 0 || height <= 0) {
    throw LogicError("camera parameters out of range: fx " + std::to_string(fx) + ", fy " +
                     std::to_string(fy) + ", picture " + std::to_string(width) + " x " +
                     std::to_string(height) + "; all must be finite, fx, fy and the size positive");
  }
}

std::vector<std::string> FocalModel::parameterNames() const
{
  std::vector<std::string> names = shapeNames();
  names.insert(names.end(), {"fx", "fy", "cx", "cy"});
  return names;
}

std::optional<Eigen::Vector2d> FocalModel::project(const Eigen::Vector3d &cX,
                                                   PointJacobian *J_point,
                                                   ParameterJacobian *J_parameters) const
{
  if (!(cX.squaredNorm() > 0.0) || !cX.allFinite()) {
    return std::nullopt;
  }
  const auto normalized = normalize(cX);
  if (!normalized) {
    return std::nullopt;
  }
  const Eigen::Vector2d f = m_parameters.segment<2>(m_shapes);
  if (J_point != nullptr) {
    *J_point = f.asDiagonal() * normalized->J_point;
  }
  if (J_parameters != nullptr) {
    J_parameters->setZero(2, m_parameters.size());
    J_parameters->leftCols(m_shapes) = f.asDiagonal() * normalized->J_shape;
    (*J_parameters)(0, m_shapes) = normalized->m.x();
    (*J_parameters)(1, m_shapes + 1) = normalized->m.y();
    J_parameters->rightCols<2>().setIdentity();
  }
  return Eigen::Vector2d(f.cwiseProduct(normalized->m) + m_parameters.tail<2>());
}

std::optional<Eigen::Vector3d> FocalModel::unproject(const Eigen::Vector2d &pixel) const
{
  const Eigen::Vector2d f = m_parameters.segment<2>(m_shapes);
  const Eigen::Vector2d m = (pixel - m_parameters.tail<2>()).cwiseQuotient(f);
  if (!m.allFinite()) {
    return std::nullopt;
  }
  const auto ray = direction(m);
  if (!ray) {
    return std::nullopt;
  }
  return ray->normalized();
}

FocalModel::Normalized FocalModel::divided(const Eigen::Vector3d &cX, double n,
                                           const Eigen::RowVector3d &dPoint,
                                           const Eigen::RowVector2d &dShape)
{
  Normalized result;
  result.m = cX.head<2>() / n;
  result.J_point = -result.m * dPoint / n;
  result.J_point.leftCols<2>().diagonal().array() += 1.0 / n;
  result.J_shape = -result.m * dShape / n;
  return result;
}

} // namespace homeward
