// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/unified_model.h>

#include <homeward/core/error.h>

namespace homeward
{
namespace
{

UnifiedCamera::Parameters unpacked(const Eigen::VectorXd &values)
{
  if (values.size() != UnifiedCamera::kParameterCount) {
    throw LogicError("the unified model has 10 parameters, not " + std::to_string(values.size()));
  }
  UnifiedCamera::Parameters p;
  double *const targets[] = {&p.xi, &p.fx, &p.fy, &p.cx, &p.cy,
                             &p.k1, &p.k2, &p.p1, &p.p2, &p.skew};
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    *targets[i] = values[i];
  }
  return p;
}

} // namespace

UnifiedModel::UnifiedModel(const Eigen::VectorXd &parameters, int width, int height)
    : m_camera(unpacked(parameters), width, height)
{}

std::vector<std::string> UnifiedModel::parameterNames() const
{
  return {"xi", "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "skew"};
}

Eigen::VectorXd UnifiedModel::parameters() const
{
  const UnifiedCamera::Parameters &p = m_camera.parameters();
  Eigen::VectorXd values(UnifiedCamera::kParameterCount);
  values << p.xi, p.fx, p.fy, p.cx, p.cy, p.k1, p.k2, p.p1, p.p2, p.skew;
  return values;
}

std::unique_ptr<CameraModel> UnifiedModel::with(const Eigen::VectorXd &parameters) const
{
  return std::make_unique<UnifiedModel>(parameters, width(), height());
}

std::optional<Eigen::Vector2d> UnifiedModel::project(const Eigen::Vector3d &cX,
                                                     PointJacobian *J_point,
                                                     ParameterJacobian *J_parameters) const
{
  if (J_parameters == nullptr) {
    return m_camera.project(cX, J_point);
  }
  UnifiedCamera::ParameterJacobian J_fixed;
  auto pixel = m_camera.project(cX, J_point, &J_fixed);
  if (pixel) {
    *J_parameters = J_fixed;
  }
  return pixel;
}

} // namespace homeward
