// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/barrier_meetings.h>

namespace homeward
{
namespace
{

constexpr double kNear = 0.6; // metres

} // namespace

void BarrierMeetings::note(Time now, double gap)
{
  if (m_underWay && !m_since && gap < kNear) {
    m_since = now;
  }
}

void BarrierMeetings::note(Time now, const NavigatorState &state)
{
  using Phase = NavigatorState::Phase;
  m_underWay = state.phase == Phase::Following || state.phase == Phase::Striding;
  bool turned = state.phase == Phase::Returning || state.phase == Phase::Finished;
  if (m_underWay) {
    const Leg leg{*state.here, state.route.front()};
    turned = m_leg != leg;
    m_leg = leg;
  }
  if (turned && m_since) {
    m_seconds.push_back(toSeconds(now - *m_since));
    m_since.reset();
  }
}

} // namespace homeward
