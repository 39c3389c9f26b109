// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>

namespace homeward
{

/**
 * The unified model of a central mirror camera with radial and tangential distortion.
 *
 * Frame c stands in the mirror's focus, z along the optical axis towards the camera (down, for an
 * upward camera), x and y along the columns and rows of the picture; an unflipped picture makes it
 * left-handed, which CameraMount knows of. With X on the unit sphere:
 *
 *     m = (X.x, X.y) / (X.z + xi)
 *     d = m (1 + k1 r^2 + k2 r^4)
 *         + (2 p1 mx my + p2 (r^2 + 2 mx^2), p1 (r^2 + 2 my^2) + 2 p2 mx my),  r = |m|
 *     u = fx d.x + skew d.y + cx,  v = fy d.y + cy
 *
 * Valid domain: z > -xi |X| for xi <= 1, z > -|X| / xi for xi > 1, and r within the range where the
 * radial polynomial grows. \cite Mei2007, eq. (1) to (5); \cite Barreto2001
 */
class UnifiedCamera
{
public:
  /** Everything that can be calibrated, in the order of the intrinsic Jacobian's columns. */
  struct Parameters
  {
    double xi = 1.0;   ///< distance of the projection centre from the sphere's
    double fx = 1.0;   ///< pixels
    double fy = 1.0;   ///< pixels
    double cx = 0.0;   ///< pixels, centre of the top-left pixel is (0, 0)
    double cy = 0.0;   ///< pixels
    double k1 = 0.0;   ///< radial distortion, second order
    double k2 = 0.0;   ///< radial distortion, fourth order
    double p1 = 0.0;   ///< tangential distortion
    double p2 = 0.0;   ///< tangential distortion
    double skew = 0.0; ///< pixels
  };

  static constexpr int kParameterCount = 10; ///< Number of values in Parameters.

  /** Of a pixel by the point that it shows. */
  using PointJacobian = Eigen::Matrix<double, 2, 3>;
  /** Of a pixel by the parameters. */
  using ParameterJacobian = Eigen::Matrix<double, 2, kParameterCount>;

  /**
   * @param width, height of the picture, pixels
   * @throw LogicError unless fx, fy, width, height > 0, xi >= 0 and all are finite
   */
  UnifiedCamera(const Parameters &parameters, int width, int height);

  /**
   * Pixel of a point.
   * @param cX point or direction in frame c, any length but zero
   * @param J_point if given, d pixel / d cX
   * @param J_parameters if given, d pixel / d parameters
   * @return nothing outside the valid domain; the pixel may lie outside the picture
   */
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d &cX,
                                         PointJacobian *J_point = nullptr,
                                         ParameterJacobian *J_parameters = nullptr) const;

  /** Unit ray of a pixel in frame c; nothing where no ray of the valid domain lands there. */
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d &pixel) const;

  /** As it was made. */
  const Parameters &parameters() const { return m_parameters; }
  /** Of the picture, pixels. */
  int width() const { return m_width; }
  /** Of the picture, pixels. */
  int height() const { return m_height; }

private:
  Parameters m_parameters;
  int m_width;
  int m_height;
  double m_largestRadius; ///< |m| up to which the radial polynomial grows
};

} // namespace homeward
