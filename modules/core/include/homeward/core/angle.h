// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace homeward
{

/** Half a turn, radians. */
inline constexpr double kPi = 3.14159265358979323846;

/** The same angle in [-pi, pi). Both in radians. */
inline double wrapAngle(double angle)
{
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped >= kPi ? wrapped - 2.0 * kPi : wrapped;
}

/** Degrees to radians. */
constexpr double radians(double degrees)
{
  return degrees * (kPi / 180.0);
}

/** Radians to degrees. */
constexpr double degrees(double radians)
{
  return radians * (180.0 / kPi);
}

} // namespace homeward
