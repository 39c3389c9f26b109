// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/sim/scene.h>

#include <memory>
#include <optional>
#include <vector>

namespace homeward
{

/** A box that stands across a way. */
struct Barrier
{
  static constexpr double kThickness = 0.2; ///< along the way, metres
  static constexpr double kHeight = 1.2;    ///< metres

  Pose2 middle;       ///< in the world; x along the way, y across
  double width = 0.0; ///< across the way, metres

  /** From a point of the floor, world frame, to the box; metres, 0 within. */
  double distanceTo(const Eigen::Vector2d &point) const;

  /** The box, for all to see and touch. */
  std::shared_ptr<const Scene> scene() const;
};

/**
 * A barrier across the middle of a straight way, 3 m wide, or as wide as leaves every place of
 * `clear` half a metre.
 * @param from, to ends of the way, metres, world frame
 * @param clear metres, world frame
 * @return nothing when the way is shorter than 1.3 m or the barrier would be narrower than 1 m
 */
std::optional<Barrier> barrierAcross(const Eigen::Vector2d &from, const Eigen::Vector2d &to,
                                     const std::vector<Eigen::Vector2d> &clear);

} // namespace homeward
