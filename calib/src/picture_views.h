// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/mirror_circles.h>

#include <functional>
#include <vector>

namespace homeward
{

/** A picture made from the mirror picture, and the way back. */
struct PictureView
{
  cv::Mat1b image;
  std::function<Eigen::Vector2d(const Eigen::Vector2d &)> toPicture; ///< pixels to pixels
};

/** The mirror picture itself, enlarged. */
PictureView enlarged(const cv::Mat1b &picture, double factor);

/** A view seen in a mirror: left and right exchanged. */
PictureView flipped(const PictureView &view);

/** How a straightened patch looks into the scene. */
struct PatchAim
{
  double azimuth = 0.0; ///< in the picture, radians
  double angle = 0.0;   ///< from the optical axis, radians
  double width = 0.0;   ///< angle of view, radians
};

/** Aims that cover the mirror twice over, so that a board lies whole in one of them. */
std::vector<PatchAim> aimsRound(double width);

/** A patch as a perspective camera in the mirror's focus would see it; border replicated. */
PictureView straightened(const cv::Mat1b &picture, const UnifiedCamera &camera, const PatchAim &aim,
                         double scale);

} // namespace homeward
