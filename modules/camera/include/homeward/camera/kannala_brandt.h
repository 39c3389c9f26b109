// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/focal_model.h>

namespace homeward
{

/**
 * `kannala_brandt`: the radius is an odd polynomial of the angle from the axis. Parameters k1, k2,
 * k3, k4, fx, fy, cx, cy.
 *
 *     t = atan2(sqrt(x^2 + y^2), z),  d = t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9
 *     m = d (x, y) / sqrt(x^2 + y^2)
 *
 * Valid domain: t below pi and below the first angle where d stops growing.
 * \cite Kannala2006, eq. (6)
 */
class KannalaBrandt : public FocalModel
{
public:
  /** @throw LogicError unless these are eight finite numbers with fx, fy > 0 */
  KannalaBrandt(const Eigen::VectorXd &parameters, int width, int height);

  std::string name() const override { return "kannala_brandt"; }
  std::unique_ptr<CameraModel> with(const Eigen::VectorXd &parameters) const override;

protected:
  std::vector<std::string> shapeNames() const override { return {"k1", "k2", "k3", "k4"}; }
  std::optional<Normalized> normalize(const Eigen::Vector3d &cX) const override;
  std::optional<Eigen::Vector3d> direction(const Eigen::Vector2d &m) const override;

private:
  double distorted(double angle) const;
  double slope(double angle) const; ///< d distorted / d angle

  double m_largestAngle; ///< radians; d grows below it
};

} // namespace homeward
