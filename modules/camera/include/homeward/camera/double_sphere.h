// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/focal_model.h>

namespace homeward
{

/**
 * `double_sphere`: a point goes onto one unit sphere, then onto a second one xi further on.
 * Parameters xi, alpha, fx, fy, cx, cy.
 *
 *     d1 = |X|,  s = xi d1 + z,  d2 = sqrt(x^2 + y^2 + s^2)
 *     m = (x, y) / (alpha d2 + (1 - alpha) s)
 *
 * Valid domain: s > -w d2 with w = alpha / (1 - alpha) for alpha <= 1/2, else (1 - alpha) / alpha.
 * For alpha = 0 it is the unified model. \cite Usenko2018, eq. (40) to (51); the domain there,
 * (43), is narrower than what the model maps uniquely.
 */
class DoubleSphere : public FocalModel
{
public:
  /** @throw LogicError unless -1 < xi <= 1, 0 <= alpha <= 1 and fx, fy > 0 */
  DoubleSphere(const Eigen::VectorXd &parameters, int width, int height);

  std::string name() const override { return "double_sphere"; }
  std::unique_ptr<CameraModel> with(const Eigen::VectorXd &parameters) const override;

protected:
  std::vector<std::string> shapeNames() const override { return {"xi", "alpha"}; }
  std::optional<Normalized> normalize(const Eigen::Vector3d &cX) const override;
  std::optional<Eigen::Vector3d> direction(const Eigen::Vector2d &m) const override;
};

} // namespace homeward
