// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/laser/clearance.h>

#include <algorithm>
#include <limits>

namespace homeward
{

/** Travel to a point that is never touched. */
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/** Squared metres from a point outside to the footprint; 0 inside. */
inline double squaredDistance(const Footprint &f, double x, double y)
{
  const double dx = std::max({f.xMin - x, x - f.xMax, 0.0});
  const double dy = std::max({f.yMin - y, y - f.yMax, 0.0});
  return dx * dx + dy * dy;
}

/** Whether a point inside, moving at (vx, vy) in the robot's frame, is noise that gets no worse. */
inline bool ignorable(const Footprint &f, double x, double y, double vx, double vy,
                      double tolerance)
{
  constexpr double kParallel = -1e-9; // a wall driven along is not driven into
  return (f.xMax - x <= tolerance && vx >= kParallel) ||
         (x - f.xMin <= tolerance && -vx >= kParallel) ||
         (f.yMax - y <= tolerance && vy >= kParallel) ||
         (y - f.yMin <= tolerance && -vy >= kParallel);
}

/** Metres until a point is touched, driving straight; direction is 1 or -1. */
inline double straightTravel(const Footprint &f, double x, double y, double direction,
                             double tolerance)
{
  if (y <= f.yMin || y >= f.yMax) {
    return kNever;
  }
  const double ahead = direction > 0.0 ? x - f.xMax : f.xMin - x;
  if (ahead >= 0.0) {
    return ahead;
  }
  const bool inside = x > f.xMin && x < f.xMax;
  return !inside || ignorable(f, x, y, -direction, 0.0, tolerance) ? kNever : 0.0;
}

/** What may stand inside a footprint grown by `margin`, while the robot does not go nearer. */
constexpr double inside(double margin)
{
  return margin + kInsideTolerance;
}

/**
 * As freeTravel(), keeping `margin` metres clear but for what stands nearer already and gets no
 * nearer.
 */
inline double guardedTravel(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
                            double margin, const Twist2 &arc, double horizon)
{
  return std::min(freeTravel(points, footprint.grown(margin), arc, horizon, inside(margin)),
                  freeTravel(points, footprint, arc, horizon));
}

} // namespace homeward
