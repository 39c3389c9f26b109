// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/mission/navigator.h>

#include "mission_words.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/topology/planner.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>

namespace homeward
{
namespace
{

using Phase = NavigatorState::Phase;

/** One step in the making. */
class Stepper
{
public:
  Stepper(const NavigatorOptions &options, const NavigatorState &state, const TopologicalMap &map)
      : m_options(options), m_map(map), m_step{state, Finish{}, {}, {}}
  {}

  Step<NavigatorState> take() { return std::move(m_step); }

  void locate()
  {
    if (++m_step.state.looks > m_options.maxLooks) {
      lose("no recognised place could be reached");
      return;
    }
    m_step.state.phase = Phase::Locating;
    m_step.command = Recognise{};
  }

  /** Approaches the likeliest place; where there is none, looks for one elsewhere. */
  void located(const Recognised &report)
  {
    NavigatorState &state = m_step.state;
    const std::optional<NodeId> place = placeToTry(report.matches);
    if (!place) {
      search();
      return;
    }
    state.phase = Phase::Approaching;
    state.route = {*place};
    HomeTo approach{*place, std::nullopt, *place == state.goal};
    if (!reachable(*place)) {
      approach.surely = true;
      approach.closely = true;
      approach.patience = m_options.approachSeconds;
    }
    m_step.command = approach;
  }

  /** The most open ways first, but on rather than back. */
  void surveyed(const Surveyed &report)
  {
    NavigatorState &state = m_step.state;
    std::vector<OpenDirection> open = report.directions;
    const bool again = state.surveyed;
    const auto back = [&](const OpenDirection &way) {
      return again && std::abs(wrapAngle(way.bearing - report.chord.bearingAtHere)) < kBack;
    };
    std::stable_sort(open.begin(), open.end(), [&](const auto &a, const auto &b) {
      return back(a) != back(b) ? back(b) : a.range > b.range;
    });
    state.surveyed = true;
    state.ways.clear();
    for (const OpenDirection &way : open) {
      state.ways.push_back(way.bearing);
    }
    if (state.ways.empty()) {
      lose("this view shows no known place, and no way is open");
      return;
    }
    search();
  }

  /** Goes straight on the next time; what bars the way asks for another. */
  void searched(const Driven &report)
  {
    std::vector<double> &ways = m_step.state.ways;
    if (!report.blocked) {
      forgive();
      ways.resize(1);
      locate();
      return;
    }
    ways.erase(ways.begin());
    if (report.chord.distance < m_options.shortestSearch && !ways.empty()) {
      search();
      return;
    }
    ways.clear();
    locate();
  }

  void approached(const Homed &report)
  {
    const NodeId place = m_step.state.route.front();
    if (report.end != HomingEnd::Arrived) {
      m_step.state.vain[place] += report.end == HomingEnd::Lost ? kLooksAlike : 1;
      locate();
      return;
    }
    stand(place);
    plan();
  }

  /** However far it came, the next place is nearer now and looks more like it. */
  void strode(const Driven &report)
  {
    const NavigatorState &state = m_step.state;
    const Edge edge = *m_map.edgeBetween(*state.here, state.route.front());
    const bool barred = report.blocked && report.chord.distance < *edge.length - kShort;
    if (barred && !state.lastTry) {
      goRound(edge);
    }
    else {
      homeToNext(std::nullopt);
    }
  }

  /** Back to the node left. */
  void goBack()
  {
    NavigatorState &state = m_step.state;
    state.phase = Phase::Returning;
    m_step.command = HomeTo{*state.here, std::nullopt, *state.here == state.goal};
  }

  void wentBack(const Homed &report)
  {
    if (report.end != HomingEnd::Arrived) {
      locate();
      return;
    }
    stand(*m_step.state.here);
    plan();
  }

  void followed(const Homed &report)
  {
    NavigatorState &state = m_step.state;
    const NodeId target = state.route.front();
    const NodeId from = *state.here;
    const std::optional<Edge> edge = m_map.edgeBetween(from, target);
    if (edge) {
      m_step.changes.emplace_back(tried(edge->id, report));
    }
    if (report.end != HomingEnd::Arrived) {
      if (edge) {
        ++state.failures[edge->id];
      }
      const bool barred = report.end == HomingEnd::Blocked || report.end == HomingEnd::TimedOut;
      if (edge && (barred || state.blocked.contains(edge->id))) {
        goRound(*edge);
      }
      else {
        locate();
      }
      return;
    }
    if (edge && state.blocked.erase(edge->id) != 0) {
      state.lastTry = false;
    }
    m_step.log.push_back(explorationLine("Navigation", from, target, std::nullopt));
    if (outdated(report, wayTo(target))) {
      m_step.refreshes.push_back(target);
    }
    state.route.erase(state.route.begin());
    stand(target);
    if (state.route.empty()) {
      arrive();
    }
    else {
      followRoute();
    }
  }

  void finish(Outcome outcome, const std::string &reason)
  {
    m_step.state.phase = Phase::Finished;
    m_step.command = Finish{outcome, reason};
  }

private:
  static constexpr double kBack = radians(60.0);
  static constexpr double kShort = 0.5; ///< metres of a way left undriven that say it is barred
  static constexpr int kLooksAlike =
      2; ///< so many barred ones an approach that ended "lost" counts as

  std::string called(NodeId id) const
  {
    const std::string &name = m_map.node(id).name;
    return name.empty() ? "node " + std::to_string(id.value) : name;
  }

  /** Of where it is now nothing is known. */
  void lose(const std::string &reason)
  {
    m_step.state.here.reset();
    finish(Outcome::Failed, "lost: " + reason);
  }

  /** From elsewhere, what was not reached may be. */
  void forgive()
  {
    for (auto &[node, times] : m_step.state.vain) {
      times = std::max(0, times - 1);
    }
  }

  /** Drives along the next way, or finds out which there are. */
  void search()
  {
    NavigatorState &state = m_step.state;
    if (state.ways.empty()) {
      state.phase = Phase::Surveying;
      m_step.command = Survey{};
      return;
    }
    state.phase = Phase::Searching;
    m_step.command = DriveDirection{state.ways.front(), m_options.searchDistance};
  }

  /** The likeliest place, as far as what was tried in vain leaves it likely. */
  std::optional<NodeId> placeToTry(const std::vector<PlaceMatch> &matches) const
  {
    std::optional<NodeId> best;
    double highest = m_options.leastProbability;
    for (const PlaceMatch &match : matches) {
      const auto vain = m_step.state.vain.find(match.node);
      const int times = vain == m_step.state.vain.end() ? 0 : vain->second;
      const double probability = match.probability * std::pow(m_options.vainFactor, times);
      if (probability > highest) {
        highest = probability;
        best = match.node;
      }
    }
    return best;
  }

  /** Whether the ways say that the robot can be there. */
  bool reachable(NodeId place) const
  {
    const std::optional<NodeId> &here = m_step.state.here;
    return here && (*here == place || m_map.edgeBetween(*here, place));
  }

  void stand(NodeId node)
  {
    NavigatorState &state = m_step.state;
    state.here = node;
    state.visited.push_back(node);
    state.ways.clear();
    state.surveyed = false;
  }

  void arrive()
  {
    m_step.log.push_back("NAVIGATION DONE -");
    finish(Outcome::Done, "arrived at " + called(m_step.state.goal));
  }

  /** From the node left, over what is not known to be barred. */
  std::optional<std::vector<NodeId>> freePath() const
  {
    const NavigatorState &state = m_step.state;
    return overSoundEdges(state.failures, m_options.legTries, [&](std::set<EdgeId> avoided) {
      avoided.insert(state.blocked.begin(), state.blocked.end());
      return shortestPath(m_map, *state.here, state.goal, avoided, m_options.cost);
    });
  }

  /** Another way begins at the node left; without one it tries again from where it stands, but
   * not for long. */
  void goRound(const Edge &edge)
  {
    NavigatorState &state = m_step.state;
    state.blocked.insert(edge.id);
    ++state.vain[state.route.front()];
    if (freePath()) {
      goBack();
    }
    else if (!state.lastTry) {
      state.lastTry = true;
      homeToNext(std::nullopt);
    }
    else {
      unreachable();
    }
  }

  void unreachable()
  {
    const NavigatorState &state = m_step.state;
    std::string reason =
        "unreachable: no way from " + called(*state.here) + " to " + called(state.goal);
    const char *separator = "; blocked: ";
    for (const EdgeId id : state.blocked) {
      const Edge &edge = m_map.edge(id);
      reason += separator + std::to_string(edge.a.value) + " - " + std::to_string(edge.b.value);
      separator = ", ";
    }
    finish(Outcome::Failed, reason);
  }

  void plan()
  {
    NavigatorState &state = m_step.state;
    std::optional<std::vector<NodeId>> path = freePath();
    if (!path && !state.blocked.empty() && !state.lastTry) {
      state.lastTry = true;
      path = shortestPath(m_map, *state.here, state.goal, {}, m_options.cost);
    }
    if (!path) {
      unreachable();
      return;
    }
    state.route.assign(path->begin() + 1, path->end());
    if (state.route.empty()) {
      arrive();
      return;
    }
    m_step.log.push_back(routeLine("Path planning", *path));
    followRoute();
  }

  void followRoute()
  {
    NavigatorState &state = m_step.state;
    const std::optional<double> departure =
        m_map.departureBearing(*state.here, state.route.front());
    const std::optional<Edge> edge = m_map.edgeBetween(*state.here, state.route.front());
    if (edge && state.failures.contains(edge->id) && departure && edge->length) {
      state.phase = Phase::Striding;
      m_step.command = DriveDirection{*departure, *edge->length};
      return;
    }
    homeToNext(departure);
  }

  void homeToNext(std::optional<double> departure)
  {
    NavigatorState &state = m_step.state;
    state.phase = Phase::Following;
    HomeTo leg{state.route.front(), departure, state.route.size() == 1};
    const std::optional<Edge> edge = m_map.edgeBetween(*state.here, state.route.front());
    leg.way = wayTo(state.route.front());
    leg.direct = leg.way.has_value();
    leg.again = !departure && edge && state.blocked.contains(edge->id);
    leg.seeAnew = leg.exactly && m_options.refresh.wanted;
    m_step.command = leg;
  }

  /** From the node left, where the map knows it. */
  std::optional<Way> wayTo(NodeId node) const
  {
    const std::optional<double> bearing = m_map.departureBearing(*m_step.state.here, node);
    const std::optional<Edge> edge = m_map.edgeBetween(*m_step.state.here, node);
    return bearing && edge->length ? std::optional(Way{*bearing, *edge->length}) : std::nullopt;
  }

  /** Whether the picture of a place that was come to no longer shows it as it is. */
  bool outdated(const Homed &report, const std::optional<Way> &way) const
  {
    const RefreshOptions &options = m_options.refresh;
    if (!options.wanted || !way || !report.seen) {
      return false;
    }
    const std::complex<double> off =
        std::polar(report.chord.distance, report.chord.bearingAtOrigin) -
        std::polar(way->distance, way->bearing);
    return std::abs(off) <= options.farthest && report.seen->likeliest &&
           report.seen->sure >= options.leastSure && report.seen->change >= options.leastChange;
  }

  const NavigatorOptions &m_options;
  const TopologicalMap &m_map;
  Step<NavigatorState> m_step;
};

} // namespace

Navigator::Navigator(const NavigatorOptions &options) : m_options(options) {}

Step<NavigatorState> Navigator::start(const TopologicalMap &map, NodeId goal,
                                      std::optional<NodeId> left) const
{
  for (const NodeId node : {goal, left.value_or(goal)}) {
    if (!map.contains(node)) {
      throw LogicError("the map has no node " + std::to_string(node.value));
    }
  }
  NavigatorState state;
  state.goal = goal;
  state.here = left;
  Stepper stepper(m_options, state, map);
  if (left) {
    stepper.goBack();
  }
  else {
    stepper.locate();
  }
  return stepper.take();
}

Step<NavigatorState> Navigator::next(const State &state, const TopologicalMap &map,
                                     const Report &report) const
{
  Stepper stepper(m_options, state, map);
  if (std::holds_alternative<Interrupted>(report)) {
    stepper.finish(Outcome::Stopped, "interrupted");
    return stepper.take();
  }
  switch (state.phase) {
  case Phase::Locating:
    stepper.located(answer<Recognised>(report));
    break;
  case Phase::Approaching:
    stepper.approached(answer<Homed>(report));
    break;
  case Phase::Surveying:
    stepper.surveyed(answer<Surveyed>(report));
    break;
  case Phase::Searching:
    stepper.searched(answer<Driven>(report));
    break;
  case Phase::Striding:
    stepper.strode(answer<Driven>(report));
    break;
  case Phase::Following:
    stepper.followed(answer<Homed>(report));
    break;
  case Phase::Returning:
    stepper.wentBack(answer<Homed>(report));
    break;
  case Phase::Finished:
    throw LogicError("the navigation has finished; no report can follow");
  }
  return stepper.take();
}

} // namespace homeward
