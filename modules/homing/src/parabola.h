// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace homeward
{

/** Offset of the lowest point of the parabola through three values, in steps, within half a step.
 */
inline double parabolaVertex(double before, double middle, double after)
{
  const double curvature = before - 2.0 * middle + after;
  return curvature > 0.0 ? std::clamp((before - after) / (2.0 * curvature), -0.5, 0.5) : 0.0;
}

} // namespace homeward
