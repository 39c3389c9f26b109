// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"

#include <homeward/calib/mirror_circles.h>
#include <homeward/camera/camera_file.h>
#include <homeward/camera/panorama.h>

namespace homeward
{

/** How the picture lies on the robot, as the command line gives it. */
struct MountOptions
{
  double forwardDegrees = -90.0;
  bool flipped = false;

  CameraMount mount() const;
};

/** Adds --forward and --flipped. */
void addMountOptions(CliCommand command, MountOptions &options);

/** The ring of a camera file from the circles in the picture, round the principal point. */
MirrorRing ringOf(const MirrorCircles &mirror, const UnifiedCamera &camera);

/** The rim as it was found, so that a camera that shifts can be followed. */
MirrorRim rimOf(const MirrorCircles &mirror);

/** A panorama of everything that the ring shows, with square pixels. */
PanoramaGeometry wholePanorama(const MirrorCamera &camera, int width = 1440);

} // namespace homeward
