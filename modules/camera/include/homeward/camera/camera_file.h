// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/unified_camera.h>

#include <Eigen/Core>

#include <optional>
#include <string>

namespace homeward
{

/** How the picture lies on the robot. */
struct CameraMount
{
  double forward =
      0.0; ///< direction in the picture, atan2(v - cy, u - cx), that shows straight ahead; radians
  /** As displayed, going clockwise round the picture turns left; so it is where nothing flips the
   * picture. */
  bool leftIsClockwise = true;
};

/** The ring of the picture that shows the scene, pixels from the principal point. */
struct MirrorRing
{
  double inner = 0.0; ///< the camera and the robot hide what is nearer
  double outer = 0.0; ///< the rim
};

/** The mirror's rim in the picture when the camera was measured: a circle, pixels. */
struct MirrorRim
{
  Eigen::Vector2d centre; ///< pixels
  double radius = 0.0;    ///< pixels
};

/** A camera file: model, ring, mount, and where the rim was. */
struct MirrorCamera
{
  UnifiedCamera model;                         ///< from rays to pixels
  MirrorRing ring;                             ///< where the picture shows the mirror
  CameraMount mount;                           ///< how it sits on the robot
  std::optional<MirrorRim> rim = std::nullopt; ///< lets followRim() see a camera that has shifted
};

/**
 * Reads a camera file: `model: unified`, `image: {width, height}`, `parameters: {xi, fx, ...}`,
 * `mirror: {inner_radius_px, outer_radius_px}`, `mount: {forward_deg, left_is_clockwise}`, and
 * where it is known `rim: {u, v, radius_px}`.
 * @param yaml its text
 * @param origin the file's name, for messages
 * @throw ConfigError naming key, value and file
 */
MirrorCamera parseMirrorCamera(const std::string &yaml, const std::string &origin);

/** The text that parseMirrorCamera() reads back. */
std::string formatMirrorCamera(const MirrorCamera &camera);

} // namespace homeward
