// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/focal_model.h>

namespace homeward
{

/**
 * `extended_unified`: a quadric of revolution instead of the sphere. Parameters alpha, beta, fx,
 * fy, cx, cy.
 *
 *     d = sqrt(beta (x^2 + y^2) + z^2),  m = (x, y) / (alpha d + (1 - alpha) z)
 *
 * Valid domain: z > -w d with w = alpha / (1 - alpha) for alpha <= 1/2, else (1 - alpha) / alpha.
 * The unified model is alpha = xi / (1 + xi), beta = 1, f = f / (1 + xi).
 * \cite Khomutenko2016
 */
class ExtendedUnified : public FocalModel
{
public:
  /** @throw LogicError unless 0 <= alpha <= 1, beta > 0 and fx, fy > 0 */
  ExtendedUnified(const Eigen::VectorXd &parameters, int width, int height);

  std::string name() const override { return "extended_unified"; }
  std::unique_ptr<CameraModel> with(const Eigen::VectorXd &parameters) const override;

protected:
  std::vector<std::string> shapeNames() const override { return {"alpha", "beta"}; }
  std::optional<Normalized> normalize(const Eigen::Vector3d &cX) const override;
  std::optional<Eigen::Vector3d> direction(const Eigen::Vector2d &m) const override;
};

} // namespace homeward
