// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/time.h>

#include <cmath>
#include <limits>
#include <vector>

namespace homeward
{

/**
 * Ranges of one sweep, at angleMin + i * angleStep, in the frame of the laser (or of the robot
 * where the text says so). NaN is unknown: not seen or dropped. A range at or above rangeMax is far
 * and open.
 */
struct Scan
{
  Time stamp{};              ///< when it was taken
  double angleMin = 0.0;     ///< radians, counter-clockwise from forward
  double angleStep = 0.0;    ///< radians, positive
  double rangeMax = 0.0;     ///< metres, what the sensor can see
  std::vector<float> ranges; ///< metres

  /** Angle of reading i, radians. */
  double angle(std::size_t i) const { return angleMin + static_cast<double>(i) * angleStep; }
};

/** The reading that says "unknown". */
inline constexpr float kUnknownRange = std::numeric_limits<float>::quiet_NaN();

} // namespace homeward
