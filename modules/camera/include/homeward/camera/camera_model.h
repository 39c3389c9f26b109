// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/**
 * A central camera: every pixel sees one ray through one point. Frame c as in UnifiedCamera. The
 * laws every model obeys are tested once for all in tests/camera.
 */
class CameraModel
{
public:
  /** Of a pixel by the point that it shows. */
  using PointJacobian = Eigen::Matrix<double, 2, 3>;
  /** Of a pixel by the model's parameters. */
  using ParameterJacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 16>;

  virtual ~CameraModel() = default;

  /** As camera files write it: unified, extended_unified, double_sphere, kannala_brandt, ocam. */
  virtual std::string name() const = 0;

  /** Names of the parameters, in the order of parameters() and of the Jacobian's columns. */
  virtual std::vector<std::string> parameterNames() const = 0;

  /** All of them, in the order of the model's names. */
  virtual Eigen::VectorXd parameters() const = 0;

  /** The same model with other parameters. @throw LogicError where they are none of this model */
  virtual std::unique_ptr<CameraModel> with(const Eigen::VectorXd &parameters) const = 0;

  /**
   * Pixel of a point.
   * @param cX point or direction in frame c, any length but zero
   * @param J_point if given, d pixel / d cX
   * @param J_parameters if given, d pixel / d parameters, 2 x parameters().size()
   * @return nothing outside the valid domain; the pixel may lie outside the picture
   */
  virtual std::optional<Eigen::Vector2d>
  project(const Eigen::Vector3d &cX, PointJacobian *J_point = nullptr,
          ParameterJacobian *J_parameters = nullptr) const = 0;

  /** Unit ray of a pixel in frame c; nothing where no ray of the valid domain lands there. */
  virtual std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d &pixel) const = 0;

  virtual int width() const = 0;  ///< pixels
  virtual int height() const = 0; ///< pixels
};

} // namespace homeward
