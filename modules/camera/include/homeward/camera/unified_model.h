// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_model.h>
#include <homeward/camera/unified_camera.h>

namespace homeward
{

/**
 * `unified`: UnifiedCamera, which says formula and domain, as one of the camera models. Parameters
 * xi, fx, fy, cx, cy, k1, k2, p1, p2, skew.
 */
class UnifiedModel : public CameraModel
{
public:
  /** The model of that camera. */
  explicit UnifiedModel(const UnifiedCamera &camera) : m_camera(camera) {}

  /** @throw LogicError unless these are ten parameters that UnifiedCamera takes */
  UnifiedModel(const Eigen::VectorXd &parameters, int width, int height);

  /** The camera itself. */
  const UnifiedCamera &camera() const { return m_camera; }

  std::string name() const override { return "unified"; }
  std::vector<std::string> parameterNames() const override;
  Eigen::VectorXd parameters() const override;
  std::unique_ptr<CameraModel> with(const Eigen::VectorXd &parameters) const override;
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d &cX,
                                         PointJacobian *J_point = nullptr,
                                         ParameterJacobian *J_parameters = nullptr) const override;
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d &pixel) const override
  {
    return m_camera.unproject(pixel);
  }
  int width() const override { return m_camera.width(); }
  int height() const override { return m_camera.height(); }

private:
  UnifiedCamera m_camera;
};

} // namespace homeward
