// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/angle.h>

#include <Eigen/Core>

namespace homeward
{

/** A planar rigid motion aMb: metres and radians, heading counter-clockwise, wrapped to [-pi, pi).
 */
struct Pose2
{
  double x = 0.0;       ///< metres
  double y = 0.0;       ///< metres
  double heading = 0.0; ///< radians

  /** Origin of b in a, metres. */
  Eigen::Vector2d translation() const { return {x, y}; }

  /** aMc = aMb * bMc. */
  Pose2 operator*(const Pose2 &bMc) const
  {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    return {x + c * bMc.x - s * bMc.y, y + s * bMc.x + c * bMc.y, wrapAngle(heading + bMc.heading)};
  }

  /** Coordinates in a of a point given in b. Metres. */
  Eigen::Vector2d operator*(const Eigen::Vector2d &bP) const
  {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    return {x + c * bP.x() - s * bP.y(), y + s * bP.x() + c * bP.y()};
  }

  /** bMa. */
  Pose2 inverse() const
  {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    return {-c * x - s * y, s * x - c * y, wrapAngle(-heading)};
  }
};

/** Velocity of a robot that cannot slide sideways: forward m/s and counter-clockwise rad/s. */
struct Twist2
{
  double v = 0.0; ///< forward, m/s
  double w = 0.0; ///< counter-clockwise, rad/s
};

/** Motion of the robot, in its own starting frame, after `seconds` at constant `twist`. */
inline Pose2 integrate(const Twist2 &twist, double seconds)
{
  const double angle = twist.w * seconds;
  const double length = twist.v * seconds;
  // sin(a)/a and (1 - cos a)/a, by series where the quotient loses digits.
  const bool small = std::abs(angle) < 1e-6;
  const double along = small ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  const double aside = small ? angle / 2.0 : (1.0 - std::cos(angle)) / angle;
  return {length * along, length * aside, wrapAngle(angle)};
}

} // namespace homeward
