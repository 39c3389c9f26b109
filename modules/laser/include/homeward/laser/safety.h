// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/angle.h>
#include <homeward/laser/clearance.h>

#include <vector>

namespace homeward
{

/** Settings of the last word before the wheels. */
struct AvoidOptions
{
  double nearDistance = 0.20;       ///< metres along the commanded path that must be free
  double margin = 0.05;             ///< metres beside that path kept free, where they are
  double turnAngle = radians(15.0); ///< rad turned away at least from what is nearer
  double turnRate = 0.5;            ///< rad/s while turning away
  double deceleration = 0.5;        ///< m/s^2 the base brakes with
  double turnDeceleration = 1.0;    ///< rad/s^2
  double reaction = 0.15;           ///< s from a scan to its effect on the wheels
};

/**
 * The fastest speed from which the robot stops within `distance`: v * reaction + v^2 / (2 a) =
 * distance. Units of `deceleration` and `distance` agree: metres, or radians for a turn.
 */
double stoppableSpeed(double distance, double deceleration, double reaction);

/**
 * What may go to the wheels instead of what somebody wants: of all actions the one with the highest
 * priority.
 *
 *     wanted                                          | result
 *     driving, path free for nearDistance             | wanted, slowed until it can stop in time
 *     driving, something nearer in the swept path     | turn on the spot, away from it
 *     the same, and neither side is free to turn      | stop
 *     turning on the spot                             | wanted, slowed until it can stop in time
 *
 * The path is the floor swept by the footprint, grown by `margin`, along the wanted arc, so that a
 * narrow door stays passable. What stands within the margin already counts when it gets nearer.
 * "Away" is the side that needs the smaller turn, at least turnAngle, until nearDistance is free
 * straight on: once begun, a turn goes on to the same side. A slowed twist keeps its arc.
 *
 * @param points obstacles in the robot's frame, metres
 * @throw LogicError for options out of bounds or a footprint without area
 */
Twist2 avoid(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
             const Twist2 &wanted, const AvoidOptions &options = {});

/** How gently to pass what is near. */
struct CreepOptions
{
  /** Metres from what is seen: furniture that is 6 cm wider lower down, noise and odometry. */
  double near = 0.09;
  double speed = 0.04; ///< m/s, > 0, of the part of the body that is near
  double ahead = 0.3;  ///< s; what will be near by then counts, as braking takes time
};

/**
 * The same arc, slowed until no part of the body passes fast by a point that is near to it, or soon
 * will be: chairs and tables are wider above and below the laser's plane.
 * @param points obstacles in the robot's frame, metres
 * @throw LogicError for a speed that is not positive
 */
Twist2 creep(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
             const Twist2 &wanted, const CreepOptions &options = {});

} // namespace homeward
