// SPDX-License-Identifier: GPL-3.0-or-later
#include "mount_options.h"

#include <homeward/core/angle.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

/** Elevation shown at a radius, all but straight up and down; radians. */
double elevationAt(const UnifiedCamera &camera, double radius)
{
  const auto &p = camera.parameters();
  for (double r = radius; r > 0.0; r -= 1.0) {
    if (const auto ray = camera.unproject({p.cx + r, p.cy})) {
      return std::clamp(std::asin(-ray->z()), radians(-85.0), radians(85.0));
    }
  }
  return radians(-85.0);
}

} // namespace

CameraMount MountOptions::mount() const
{
  return {radians(forwardDegrees), !flipped};
}

void addMountOptions(CliCommand command, MountOptions &options)
{
  command
      .option("--forward", options.forwardDegrees,
              "Direction in the picture that shows straight ahead, degrees, 0 right, -90 up")
      .between(-360.0, 360.0)
      .showDefault();
  command.flag("--flipped", options.flipped, "The picture is flipped, writing reads normally");
}

MirrorRing ringOf(const MirrorCircles &mirror, const UnifiedCamera &camera)
{
  constexpr double kEdge = 3.0; // pixels; an edge is never sharp
  const Eigen::Vector2d centre(camera.parameters().cx, camera.parameters().cy);
  const double inner = mirror.inner.radius > 0.0
                           ? mirror.inner.radius + (mirror.inner.centre - centre).norm() + kEdge
                           : 0.0;
  const double outer = mirror.outer.radius - (mirror.outer.centre - centre).norm() - kEdge;
  return {inner, std::max(outer, inner + 1.0)};
}

MirrorRim rimOf(const MirrorCircles &mirror)
{
  return {mirror.outer.centre, mirror.outer.radius};
}

PanoramaGeometry wholePanorama(const MirrorCamera &camera, int width)
{
  PanoramaGeometry geometry;
  geometry.width = width;
  geometry.elevationMax = elevationAt(camera.model, camera.ring.outer);
  geometry.elevationMin =
      std::min(elevationAt(camera.model, camera.ring.inner), geometry.elevationMax - radians(1.0));
  geometry.height = std::max(
      8, static_cast<int>((geometry.elevationMax - geometry.elevationMin) / (2.0 * kPi) * width));
  return geometry;
}

} // namespace homeward
