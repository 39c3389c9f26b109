// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace homeward
{

/**
 * What a view says without any camera model but a centre: in any picture that is symmetric round
 * its centre, pixel and point lie in the same direction from the axis, (u - cx) b = (v - cy) a with
 * (a, b) the first two coordinates of the point in frame c. Linear in two rows of the pose; the
 * third follows from the rotation, but for the distance along the axis and, of a flat target, for
 * the side it leans to. \cite Scaramuzza2006, eq. (10) to (13); \cite Hartley2007
 */
struct RadialPose
{
  double rms = 0.0;                    ///< across the radius, pixels
  std::vector<Eigen::Isometry3d> cMos; ///< one or two; translation.z() is open, 0
};

/** Nothing when fewer than six points, or points on a line, say nothing. */
std::optional<RadialPose> radialPose(const BoardView &view, const Eigen::Vector2d &centre);

/** The centre that all views agree on best, found from a grid over the picture. */
Eigen::Vector2d radialCentre(const BoardViews &views);

/** Where a calibration may start: the unified model without distortion, and poses. */
struct RadialStart
{
  double xi = 1.0;                                  ///< of the unified model
  double f = 1.0;                                   ///< pixels
  Eigen::Vector2d centre = Eigen::Vector2d::Zero(); ///< of the picture's distortion, pixels
  std::vector<Eigen::Isometry3d> cMo;               ///< one a view
  double error = 0.0;                               ///< of the angles from the axis, radians, rms
};

/** Poses for a camera; nothing when a view has no radialPose() or cannot be seen. */
std::optional<RadialStart> radialStart(const BoardViews &views, double xi, double f,
                                       const Eigen::Vector2d &centre);

/** The best starts of a centre over all xi and f, best first, at most `count`, one a xi. */
std::vector<RadialStart> radialStarts(const BoardViews &views, const Eigen::Vector2d &centre,
                                      int count);

} // namespace homeward
