// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>

#include <deque>
#include <optional>

namespace homeward
{

/**
 * The way the robot came, in the odometry frame: the last few metres, which were free for its body
 * and so lead out of where it is stuck, backwards.
 */
class Trail
{
public:
  /** Takes the pose of the robot while it drives on. */
  void add(const Pose2 &oMr);

  /**
   * The twist that leads back along the trail, slowly; forgets what has been gone back over.
   * @return nothing where the trail begins, or when the robot is not on it
   */
  std::optional<Twist2> wayBack(const Pose2 &oMr);

private:
  std::deque<Pose2> m_poses; ///< odometry frame, oldest first
};

} // namespace homeward
