// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>

#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace homeward
{

/**
 * The simulated mirror and camera as they really are: a hyperboloid over a perspective camera in
 * its second focus, slightly off what the camera file says. The robot never reads this.
 *
 * With eccentricity e, a ray at angle t from the axis (towards the camera) is imaged at radius
 * R = f (e^2 - 1) sin t / ((e^2 + 1) cos t + 2 e), f the focal length of the perspective camera.
 * \cite Baker1999 gives the mirror, \cite Geyer2000 the equality with xi = 2 e / (1 + e^2).
 */
struct TrueOptics
{
  int width = 640;                      ///< pixels
  int height = 480;                     ///< pixels
  double eccentricity = 1.5;            ///< of the hyperboloid, > 1
  Eigen::Vector2d focal{350.0, 350.0};  ///< of the perspective camera, pixels along u and v
  Eigen::Vector2d centre{319.5, 239.5}; ///< image of the mirror's axis, pixels
  Eigen::Matrix3d pRa = Eigen::Matrix3d::Identity(); ///< mirror axes a (as p, untilted) in p
  double innerRadius = 30.0;                         ///< pixels; camera and robot hide inside
  double outerRadius = 236.0;                        ///< pixels; the mirror's rim
  CameraMount mount;

  /** Unit ray of a pixel in frame p, the mirror's focus; nothing far beyond the rim. */
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d &pixel) const;

  /** Pixel of a direction in frame p, the inverse of ray(); it may lie outside the mirror. */
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d &pX) const;
};

/**
 * Optics near a camera file: tilt up to 0.5 degrees, centre up to 3 px and focal length up to 0.5 %
 * off, drawn from the seed.
 * @throw LogicError when the nominal xi is not in (0, 1): no hyperboloid has it
 */
TrueOptics drawOptics(const MirrorCamera &nominal, std::uint64_t seed);

/** Optics exactly as the camera file says, but for lens distortion, which no simulation has. */
TrueOptics exactOptics(const MirrorCamera &nominal);

} // namespace homeward
