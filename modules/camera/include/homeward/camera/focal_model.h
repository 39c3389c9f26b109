// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_model.h>

namespace homeward
{

/**
 * What the models share that end in u = fx m.x + cx, v = fy m.y + cy: parameters are those of the
 * shape, then fx, fy, cx, cy.
 */
class FocalModel : public CameraModel
{
public:
  Eigen::VectorXd parameters() const override { return m_parameters; }
  std::vector<std::string> parameterNames() const override;
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d &cX,
                                         PointJacobian *J_point = nullptr,
                                         ParameterJacobian *J_parameters = nullptr) const override;
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d &pixel) const override;
  int width() const override { return m_width; }
  int height() const override { return m_height; }

protected:
  /** A point in the normalised picture. */
  struct Normalized
  {
    Eigen::Vector2d m;     ///< the point in the plane at distance 1, before focal length and centre
    PointJacobian J_point; ///< d m / d cX
    Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 4> J_shape; ///< d m / d shape
  };

  /** @throw LogicError unless these are shapes + 4 finite numbers with fx, fy, width, height > 0 */
  FocalModel(const Eigen::VectorXd &parameters, int shapes, int width, int height);

  /** What the parameters after focal length and centre are called. */
  virtual std::vector<std::string> shapeNames() const = 0;

  /** m of a point of any length but zero; nothing outside the domain. */
  virtual std::optional<Normalized> normalize(const Eigen::Vector3d &cX) const = 0;

  /** Direction of m, of any length; nothing where no ray of the domain lands there. */
  virtual std::optional<Eigen::Vector3d> direction(const Eigen::Vector2d &m) const = 0;

  /** The i-th parameter after focal length and centre. */
  double shape(int i) const { return m_parameters[i]; }

  /** m = (x, y) / n from n and its gradients. */
  static Normalized divided(const Eigen::Vector3d &cX, double n, const Eigen::RowVector3d &dPoint,
                            const Eigen::RowVector2d &dShape);

private:
  Eigen::VectorXd m_parameters;
  int m_shapes;
  int m_width;
  int m_height;
};

} // namespace homeward
