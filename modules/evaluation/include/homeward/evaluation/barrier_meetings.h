// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/time.h>
#include <homeward/mission/navigator.h>

#include <optional>
#include <utility>
#include <vector>

namespace homeward
{

/**
 * How long a barrier holds a navigation up. A meeting begins when the robot, on a leg of its route,
 * first is within 0.6 m of the barrier. It ends with the step that takes another leg, goes back to
 * the node left or finishes; not by trying the same leg once more or finding out where it is.
 */
class BarrierMeetings
{
public:
  /** The robot is somewhere. @param gap metres from its outermost point to the barrier */
  void note(Time now, double gap);

  /** A step of the navigation begins. */
  void note(Time now, const NavigatorState &state);

  /** Of each meeting that has ended, simulated s. */
  const std::vector<double> &seconds() const { return m_seconds; }

private:
  using Leg = std::pair<NodeId, NodeId>; ///< from, to

  bool m_underWay = false;     ///< on m_leg
  std::optional<Leg> m_leg;    ///< the newest
  std::optional<Time> m_since; ///< of the meeting that has not ended
  std::vector<double> m_seconds;
};

} // namespace homeward
