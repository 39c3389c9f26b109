// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>

#include <optional>

namespace homeward
{

/**
 * Odometry whose turns are as long as the robot's. Wheels that skid count more turn than there is,
 * by a share that depends on the floor and on the tyres; views of a place left behind tell it.
 */
class TurnCalibration
{
public:
  /** The corrected pose when the base says `raw`; the first is taken as it is. */
  Pose2 follow(const Pose2 &raw);

  /** Turned so far as the base counts it, radians, left less right. */
  double turned() const { return m_turned; }

  /**
   * The heading was seen to have changed by `missing` more than the corrected odometry says, over a
   * turn of `turned` radians as the base counts it. A scalar Kalman filter of the share.
   * @return false, and nothing is learnt, when skidding does not explain it: a view mistaken
   */
  bool learn(double turned, double missing);

  /** Share of a turn that is not there; negative when more is there than counted. */
  double share() const { return m_share; }

private:
  std::optional<Pose2> m_raw; ///< last
  Pose2 m_pose;               ///< of it
  double m_turned = 0.0;
  double m_share = 0.0;
  double m_variance = 0.06 * 0.06; ///< of the share; skid-steered robots before anything is known
};

} // namespace homeward
