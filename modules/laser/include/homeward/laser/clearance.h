// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>

#include <Eigen/Core>

#include <vector>

namespace homeward
{

/** What the robot covers of the floor: a rectangle in the robot's frame, metres. */
struct Footprint
{
  double xMin = -0.25;  ///< rear, metres
  double xMax = 0.25;   ///< front, metres
  double yMin = -0.245; ///< right side, metres
  double yMax = 0.245;  ///< left side, metres

  /** Grown by `margin` metres on every side. */
  Footprint grown(double margin) const
  {
    return {xMin - margin, xMax + margin, yMin - margin, yMax + margin};
  }
};

/**
 * Metres from the footprint to the nearest point; 0 when one is inside, infinity without points.
 * @param points obstacles in the robot's frame, metres
 * @throw LogicError for a footprint without area
 */
double clearance(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint);

/** Metres a point may stand inside the footprint for no other reason than sensor noise. */
inline constexpr double kInsideTolerance = 0.02;

/**
 * How far the footprint travels along the arc of a twist before it touches a point: metres along
 * the path of the robot's origin, for a turn on the spot radians. Exact.
 *
 * The robot turns about c = (0, v / w); seen from it, a point goes round c the other way and
 * touches where its circle first meets the rectangle.
 *
 * A point inside the footprint by up to `tolerance` is noise as long as the motion does not take
 * it deeper at once (then it counts again when it comes back); any other point inside leaves no
 * travel at all.
 *
 * @param points obstacles in the robot's frame, metres
 * @param arc only the ratio and the signs of v and w matter; v may be negative
 * @param horizon the most that is answered, metres or radians; also the answer for no motion
 * @throw LogicError for a footprint without area or a negative horizon
 */
double freeTravel(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
                  const Twist2 &arc, double horizon, double tolerance = kInsideTolerance);

} // namespace homeward
