// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/unified_camera.h>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <optional>

namespace homeward
{

/** A circle in a picture, pixels. */
struct Circle
{
  Eigen::Vector2d centre{0.0, 0.0}; ///< pixels
  double radius = 0.0;              ///< pixels
};

/** The ring of a picture that shows the scene: the mirror without what hides its middle. */
struct MirrorCircles
{
  Circle inner; ///< the camera's own picture; radius 0 when nothing hides the middle
  Circle outer; ///< the rim; the picture may cut it
};

/**
 * Finds the mirror without a target: circles that many rays from the middle meet as an edge, the
 * scene between the two of them and nothing of it beyond.
 * @param picture CV_8UC1 or CV_8UC3; several pictures of one camera, averaged, serve better
 * @return nothing where no circle shows
 * @throw LogicError for other types
 */
std::optional<MirrorCircles> findMirror(const cv::Mat &picture);

/** CV_8UC1, 255 where the ring shows the scene. */
cv::Mat mirrorMask(const MirrorCircles &mirror, int width, int height);

/**
 * What such mirrors are like: good enough to straighten pictures for a detector, not to measure.
 * Without a mirror, a circle that fills the picture.
 */
UnifiedCamera roughCamera(const std::optional<MirrorCircles> &mirror, int width, int height);

} // namespace homeward
