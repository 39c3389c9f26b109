// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/robot/rig.h>

namespace homeward
{

/** A velocity as it travels to a Pioneer. */
struct WholeVelocity
{
  int speed = 0;    ///< mm/s forward
  int turnRate = 0; ///< deg/s counter-clockwise

  bool operator==(const WholeVelocity &) const = default;
};

/**
 * Makes whole mm/s and deg/s of velocities so that the mean of what is sent is what was wanted:
 * what one command lost by rounding, at most half a unit, is added to the next (first-order noise
 * shaping). Zero stays zero and forgets what was carried, no sign is turned round, and no limit is
 * passed: not by the part of a unit either.
 */
class VelocityRounder
{
public:
  /** @param limits that what is carried never goes beyond */
  explicit VelocityRounder(const Limits &limits);

  /** The next command. @param wanted m/s, rad/s @throw LogicError when not finite */
  WholeVelocity next(const Twist2 &wanted);

  /** Carries nothing on: the robot is told to stand. */
  void forget();

private:
  /** One of the two numbers. */
  struct Axis
  {
    int most = 0;         ///< whole units
    double carried = 0.0; ///< units, within half of one

    int next(double units);
  };

  Axis m_speed;
  Axis m_turnRate;
};

} // namespace homeward
