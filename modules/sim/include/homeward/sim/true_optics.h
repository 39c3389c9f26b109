// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>

#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace homeward
{

/**
 * The simulated mirror and camera as they really are, slightly off what the camera file says. The
 * robot never reads this.
 *
 * A hyperboloid of eccentricity e over a perspective camera of focal length g in its second focus
 * images a ray at angle t from the axis (towards the camera) at radius R = f sin t / (cos t + xi),
 * xi = 2 e / (e^2 + 1), f = g (e^2 - 1) / (e^2 + 1). \cite Baker1999 gives the mirror,
 * \cite Geyer2000 the equality. With xi = 1 the mirror is a paraboloid; above, R is that of no
 * single mirror but of some wide lenses.
 */
struct TrueOptics
{
  int width = 640;                                   ///< pixels
  int height = 480;                                  ///< pixels
  double xi = 0.92;                                  ///< > 0
  Eigen::Vector2d focal{135.0, 135.0};               ///< f, pixels along u and v
  Eigen::Vector2d centre{319.5, 239.5};              ///< image of the mirror's axis, pixels
  Eigen::Matrix3d pRa = Eigen::Matrix3d::Identity(); ///< mirror axes a (as p, untilted) in p
  double innerRadius = 30.0;                         ///< pixels; camera and robot hide inside
  double outerRadius = 236.0;                        ///< pixels; the mirror's rim
  CameraMount mount;                                 ///< as it truly sits on the robot

  /** Unit ray of a pixel in frame p, the mirror's focus; nothing far beyond the rim. */
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d &pixel) const;

  /** Pixel of a direction in frame p, the inverse of ray(); it may lie outside the mirror. */
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d &pX) const;
};

/**
 * Optics near a camera file: tilt up to 0.5 degrees, centre up to 3 px and focal length up to 0.5 %
 * off, drawn from the seed.
 * @throw LogicError as exactOptics()
 */
TrueOptics drawOptics(const MirrorCamera &nominal, std::uint64_t seed);

/**
 * Optics exactly as the camera file says, but for lens distortion, which no simulation has.
 * @throw LogicError unless the nominal xi is positive: a camera without a mirror has 0
 */
TrueOptics exactOptics(const MirrorCamera &nominal);

} // namespace homeward
