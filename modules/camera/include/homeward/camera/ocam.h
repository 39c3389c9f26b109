// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_model.h>

namespace homeward
{

/**
 * `ocam`: the ray of a pixel is a polynomial of its distance from the centre. Parameters a0, a2,
 * a3, ... aN (1 <= N - 1 <= 8), c, d, e, cx, cy, all in pixels and their powers.
 *
 *     u = x + e y + cx,  v = d x + c y + cy
 *     ray = (x, y, a0 + a2 r^2 + a3 r^3 + ... + aN r^N),  r = sqrt(x^2 + y^2)
 *
 * OCamCalib writes rows before columns and z away from the camera: its polynomial is the negative.
 *
 * Valid domain: r below half the picture's perimeter and below the first r at which the angle from
 * the axis stops growing. The pixel of a ray is a root of the polynomial, its Jacobian the implicit
 * function's. \cite Scaramuzza2006, eq. (3) to (6)
 */
class Ocam : public CameraModel
{
public:
  static constexpr int kAffine = 5; ///< c, d, e, cx, cy

  /** @throw LogicError unless all are finite, a0 > 0, c - d e > 0 and the picture has pixels */
  Ocam(const Eigen::VectorXd &parameters, int width, int height);

  std::string name() const override { return "ocam"; }
  std::vector<std::string> parameterNames() const override;
  Eigen::VectorXd parameters() const override { return m_parameters; }
  std::unique_ptr<CameraModel> with(const Eigen::VectorXd &parameters) const override;
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d &cX,
                                         PointJacobian *J_point = nullptr,
                                         ParameterJacobian *J_parameters = nullptr) const override;
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d &pixel) const override;
  int width() const override { return m_width; }
  int height() const override { return m_height; }

private:
  double height(double r) const; ///< z of the ray, the polynomial
  double slope(double r) const;  ///< d height / d r

  /** r of a direction, nothing outside the domain. */
  std::optional<double> radius(double across, double z) const;

  Eigen::VectorXd m_parameters;
  Eigen::Index m_terms; ///< of the polynomial
  int m_width;
  int m_height;
  Eigen::Matrix2d m_affine;
  double m_largestRadius = 0.0;
};

} // namespace homeward
