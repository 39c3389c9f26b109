// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/run/navigation.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

/** A picture is taken some centimetres off the one before, and such errors add up. */
constexpr int kMostRefreshes = 3;

/** The navigator, as far as a map file can keep what it decides. */
struct KeptNavigator
{
  using State = NavigatorState;

  Step<State> next(const State &state, const TopologicalMap &map, const Report &report) const
  {
    Step<State> step = navigator.next(state, map, report);
    if (file != nullptr) {
      std::erase_if(step.changes, [this](const MapChange &change) { return !canKeep(change); });
      std::erase_if(step.refreshes, [this](NodeId node) { return !canRefresh(node); });
    }
    return step;
  }

  /** Goals of pictures, and the ways there, are not of the file. */
  bool canKeep(const MapChange &change) const
  {
    const auto *tried = std::get_if<EdgeTried>(&change);
    return tried == nullptr || file->map().edges().contains(tried->edge);
  }

  bool canRefresh(NodeId node) const
  {
    return file->map().contains(node) && refreshesOf(*file, node) < kMostRefreshes;
  }

  Navigator navigator;
  const MapFile *file; ///< null: nothing is kept
};

} // namespace

Navigation::Navigation(const MapFile &file, Pilot &pilot, const Clock &clock, MapFile *kept)
    : m_map(file.map()), m_kept(kept), m_pilot(pilot), m_clock(clock)
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
    report.refreshed = report.refreshed || !step.refreshes.empty();
    if (m_kept != nullptr) {
      std::for_each(step.changes.begin(), step.changes.end(),
                    [this](const MapChange &change) { m_map.apply(change); });
    }
    if (onStep) {
      onStep(step);
    }
  };
  const KeptNavigator mission{Navigator({.refresh = {.wanted = m_kept != nullptr}}), m_kept};
  MissionCounts counts;
  const Finish finish = runMission(mission, mission.navigator.start(m_map, goal, m_left), m_pilot,
                                   m_map, m_kept, m_clock, counts, enough, noteStep);
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
