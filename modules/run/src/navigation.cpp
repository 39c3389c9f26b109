// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/run/navigation.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

Navigation::Navigation(const MapFile &file, Pilot &pilot, const Clock &clock)
    : m_map(file.map()), m_pilot(pilot), m_clock(clock)
{
  rememberAll(file, pilot);
}

std::optional<PlaceMatch> Navigation::addPicture(const std::string &name, const Panorama &picture)
{
  const std::vector<PlaceMatch> matches = m_pilot.recognise(picture);
  const auto place = std::find_if(matches.begin(), matches.end(),
                                  [](const PlaceMatch &match) { return match.verified; });
  if (place == matches.end()) {
    return std::nullopt;
  }
  const NodeId node = m_map.nextNodeId();
  m_map.apply(NodeAdded{{.id = node, .name = name}});
  m_map.apply(EdgeAdded{{.id = m_map.nextEdgeId(), .a = place->node, .b = node}});
  m_pilot.remember(node, picture);
  return *place;
}

GoalReport Navigation::driveTo(NodeId goal, double maxSeconds)
{
  const Time begin = m_clock.now();
  const auto seconds = [&] { return toSeconds(m_clock.now() - begin); };
  bool timeIsOver = false;
  const auto enough = [&] { return timeIsOver = seconds() > maxSeconds; };
  GoalReport report;
  report.goal = goal;
  const auto noteStep = [&](const Step<NavigatorState> &step) {
    m_left = step.state.here;
    report.path = step.state.visited;
    if (onStep) {
      onStep(step);
    }
  };
  const Navigator navigator({});
  MissionCounts counts;
  const Finish finish = runMission(navigator, navigator.start(m_map, goal, m_left), m_pilot, m_map,
                                   nullptr, m_clock, counts, enough, noteStep);
  report.seconds = seconds();
  report.outcome = finish.outcome;
  report.reason = finish.reason;
  if (finish.outcome == Outcome::Stopped && timeIsOver) {
    report.outcome = Outcome::Failed;
    report.reason = "not there after " + std::to_string(std::lround(maxSeconds)) + " s";
  }
  return report;
}

} // namespace homeward
