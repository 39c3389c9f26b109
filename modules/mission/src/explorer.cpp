// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/mission/explorer.h>

#include "mission_words.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/topology/planner.h>
#include <homeward/topology/reckoning.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

using Phase = ExplorerState::Phase;

/** One step in the making: a copy of the state and of the map that grows with the changes. */
class Stepper
{
public:
  Stepper(const ExplorerOptions &options, const ExplorerState &state, const TopologicalMap &map)
      : m_options(options), m_map(map), m_step{state, Finish{}, {}, {}}
  {
    ++m_step.state.steps;
  }

  Step<ExplorerState> take() { return std::move(m_step); }

  /** Where nobody knows which place the robot left and what it drove since. */
  void begin()
  {
    ExplorerState &state = m_step.state;
    const bool finished = state.phase == Phase::Finished;
    ExplorerState kept;
    kept.steps = state.steps;
    kept.failures = std::move(state.failures);
    kept.attempts = std::move(state.attempts);
    state = std::move(kept);
    if (m_map.nodes().empty()) {
      survey();
    }
    else if (finished || m_map.openDirectionCount() == 0) {
      end();
    }
    else {
      ask(Phase::Relocating, Recognise{});
    }
  }

  void surveyed(const Surveyed &report)
  {
    const NodeId node = m_map.nextNodeId();
    Node added{node, {}};
    for (const OpenDirection &open : report.directions) {
      added.directions.push_back({DirectionId{static_cast<std::int64_t>(added.directions.size())},
                                  open.bearing, open.width, DirectionState::Open, ""});
    }
    change(NodeAdded{added});
    if (m_step.state.origin) {
      m_step.log.push_back(
          explorationLine("Exploration", *m_step.state.origin, node, std::nullopt));
    }
    connect(node, report.chord);
    leave(node);
  }

  void driven(const Driven &report)
  {
    m_step.state.chord = report.chord;
    if (report.blocked && report.chord.distance < m_options.shortestDrive) {
      settle(DirectionState::Closed, "blocked");
      m_step.state.direction.reset();
      home(Phase::Homing, *m_step.state.origin, std::nullopt);
      return;
    }
    ask(Phase::Classifying, Recognise{});
  }

  void classified(const Recognised &report)
  {
    const PlaceMatch *known = placeHere(report.matches, false);
    const bool unsure = known == nullptr;
    if (unsure) {
      known = placeHere(report.matches, true);
    }
    if (known == nullptr) {
      survey();
      return;
    }
    if (known->node == m_step.state.origin) {
      settle(DirectionState::Closed, "leads back to the same place");
    }
    m_step.state.dissimilarity = known->dissimilarity;
    home(Phase::Homing, known->node, std::nullopt, unsure);
  }

  void homed(const Homed &report)
  {
    ExplorerState &state = m_step.state;
    const NodeId target = *state.target;
    state.chord = report.chord;
    if (report.end == HomingEnd::Arrived) {
      if (state.direction && state.origin) {
        m_step.log.push_back(
            explorationLine("Exploration(Homing)", *state.origin, target, state.dissimilarity));
      }
      connect(target, report.chord);
      leave(target);
    }
    else if (++state.retries < m_options.homingTries) {
      state.vain[target] += report.end == HomingEnd::Lost ? kLooksAlike : 1;
      ask(Phase::Classifying, Recognise{});
    }
    else if (!state.origin || isWay(report.chord)) {
      survey();
    }
    else {
      ++state.vain[target];
      home(Phase::Returning, *state.origin, std::nullopt);
    }
  }

  void followed(const Homed &report)
  {
    ExplorerState &state = m_step.state;
    const std::optional<Edge> edge = m_map.edgeBetween(*state.origin, state.route.front());
    if (edge) {
      change(tried(edge->id, report));
    }
    if (report.end == HomingEnd::Arrived) {
      const NodeId reached = state.route.front();
      state.route.erase(state.route.begin());
      state.origin = reached;
      state.chord = {};
      state.retries = 0;
      state.retreated = false;
      state.vain.clear();
      if (state.route.empty()) {
        leave(reached);
      }
      else {
        followRoute();
      }
      return;
    }
    if (edge) {
      ++state.failures[edge->id];
    }
    state.chord = report.chord;
    ++state.vain[state.route.front()];
    if (m_options.relocates) {
      ask(Phase::Relocating, Recognise{});
    }
    else {
      survey();
    }
  }

  /** However far it came, the next place is nearer now and looks more like it. */
  void strode(const Driven &report)
  {
    m_step.state.chord = report.chord;
    m_step.state.strode = true;
    home(Phase::Following, m_step.state.route.front(), std::nullopt);
  }

  void relocated(const Recognised &report)
  {
    ExplorerState &state = m_step.state;
    std::vector<PlaceMatch> matches = report.matches;
    std::erase_if(matches, [this](const PlaceMatch &match) {
      return !plausible(match.node, m_options.nearPlace);
    });
    if (state.stranded > 0) {
      std::erase_if(matches, [this](const PlaceMatch &match) { return !pathToOpen(match.node); });
    }
    const std::optional<NodeId> place = likeliestPlace(notInVain(matches, state.vain, 1));
    const bool tried = state.retries++ > 1;
    if (place && !tried) {
      home(Phase::Returning, *place, std::nullopt);
    }
    else if (state.stranded > 0) {
      plan(*state.origin);
    }
    else if (const auto back = state.retreated ? std::nullopt : retreat()) {
      state.retreated = true;
      ask(Phase::Retreating, *back);
    }
    else {
      survey();
    }
  }

  void retreated(const Driven &report)
  {
    m_step.state.chord = report.chord;
    home(Phase::Returning, *m_step.state.origin, std::nullopt);
  }

  void returned(const Homed &report)
  {
    if (report.end == HomingEnd::Arrived) {
      if (m_step.state.target == m_step.state.origin) {
        giveUp();
      }
      connect(*m_step.state.target, report.chord);
      leave(*m_step.state.target);
    }
    else {
      ++m_step.state.vain[*m_step.state.target];
      m_step.state.chord = report.chord;
      ask(Phase::Relocating, Recognise{});
    }
  }

  /** The command that the state waits for an answer to. */
  Command pending() const
  {
    const ExplorerState &state = m_step.state;
    switch (state.phase) {
    case Phase::Surveying:
      return Survey{};
    case Phase::Driving:
      return drive(directionDriven());
    case Phase::Classifying:
    case Phase::Relocating:
      return Recognise{};
    case Phase::Homing:
    case Phase::Returning:
      return homeTo(std::nullopt);
    case Phase::Following:
      return homeTo(state.strode
                        ? std::nullopt
                        : m_map.departureBearing(named(state.origin), named(state.target)));
    case Phase::Striding:
      return named(stride());
    case Phase::Retreating:
      return named(retreat());
    case Phase::Finished:
      break;
    }
    return ending();
  }

  void interrupt()
  {
    --m_step.state.steps;
    m_step.command = Finish{Outcome::Stopped, "interrupted"};
  }

private:
  static constexpr int kLooksAlike = 2; ///< homings in vain that one that ended "lost" counts as

  struct Offset
  {
    double distance = 0.0; ///< metres
    double error = 0.0;    ///< of it by the ways, metres, one sigma
  };

  void ask(Phase phase, const Command &command)
  {
    m_step.state.phase = phase;
    m_step.command = command;
  }

  void survey() { ask(Phase::Surveying, Survey{}); }

  /** @param surely to make sure of the node, whatever the ways say */
  void home(Phase phase, NodeId node, std::optional<double> departure, bool surely = false)
  {
    ExplorerState &state = m_step.state;
    state.phase = phase;
    state.target = node;
    state.surely = surely;
    m_step.command = homeTo(departure);
  }

  /** Where places far round are alike, only sight tells that it is the one. */
  HomeTo homeTo(std::optional<double> departure) const
  {
    const ExplorerState &state = m_step.state;
    const NodeId node = named(state.target);
    const auto off = state.phase == Phase::Following ? std::optional(Offset{}) : offset(node);
    const bool far = !off || off->error > m_options.surelyBeyond;
    return {node, departure, false, state.surely || far};
  }

  /** To the place left by odometry, which is good enough over a few metres. */
  std::optional<DriveDirection> retreat() const
  {
    const ExplorerState &state = m_step.state;
    if (!m_options.retreats || !state.origin || state.chord.distance > m_options.longestEdge()) {
      return std::nullopt;
    }
    return DriveDirection{wrapAngle(state.chord.bearingAtOrigin + kPi), state.chord.distance};
  }

  /** The next leg by its bearing and length, when it has failed and the map knows both. */
  std::optional<DriveDirection> stride() const
  {
    const ExplorerState &state = m_step.state;
    if (!m_options.strides || state.route.empty()) {
      return std::nullopt;
    }
    const NodeId origin = named(state.origin);
    const std::optional<double> departure = m_map.departureBearing(origin, state.route.front());
    const std::optional<Edge> edge = m_map.edgeBetween(origin, state.route.front());
    if (!departure || !edge->length || !state.failures.contains(edge->id)) {
      return std::nullopt;
    }
    return DriveDirection{*departure, *edge->length};
  }

  DriveDirection drive(const Direction &direction) const
  {
    return {direction.bearing, m_options.forwardDistance};
  }

  const Direction &directionDriven() const
  {
    const std::vector<Direction> &directions = m_map.node(named(m_step.state.origin)).directions;
    const DirectionId wanted = named(m_step.state.direction);
    const auto found = std::find_if(directions.begin(), directions.end(),
                                    [&](const Direction &each) { return each.id == wanted; });
    if (found == directions.end()) {
      throw LogicError("the exploration drives direction " + std::to_string(wanted.value) +
                       " of a node that has none such");
    }
    return *found;
  }

  /** What the phase cannot be without. */
  template <class Id> static Id named(const std::optional<Id> &id)
  {
    if (!id) {
      throw LogicError("the exploration's state lacks what its phase needs");
    }
    return *id;
  }

  bool tooManyNodes() const { return static_cast<int>(m_map.nodes().size()) > m_options.maxNodes; }

  Finish ending() const
  {
    if (tooManyNodes()) {
      return {Outcome::Failed, "the map has grown beyond " + std::to_string(m_options.maxNodes) +
                                   " nodes; places are not recognised again"};
    }
    return {Outcome::Done, "no reachable node has an open direction"};
  }

  void end()
  {
    const Finish finish = ending();
    ask(Phase::Finished, finish);
    if (finish.outcome == Outcome::Done) {
      m_step.log.push_back("EXPLORATION DONE - -");
    }
  }

  void change(const MapChange &made)
  {
    m_map.apply(made);
    m_step.changes.push_back(made);
  }

  /** Settles the direction that is being driven, if one is. */
  void settle(DirectionState to, const std::string &reason)
  {
    const ExplorerState &state = m_step.state;
    if (state.origin && state.direction) {
      for (const Direction &direction : m_map.node(*state.origin).directions) {
        if (direction.id == *state.direction && direction.state == DirectionState::Open) {
          change(DirectionSettled{*state.origin, *state.direction, to, reason});
          return;
        }
      }
    }
  }

  /** Settles the open directions of `node` that lead along a way already driven. */
  void settleAlong(NodeId node, double bearing, NodeId other)
  {
    const std::vector<Direction> directions = m_map.node(node).directions;
    for (const Direction &direction : directions) {
      if (direction.state == DirectionState::Open &&
          std::abs(wrapAngle(direction.bearing - bearing)) < m_options.settledAngle) {
        change(DirectionSettled{node, direction.id, DirectionState::Driven,
                                "leads to node " + std::to_string(other.value)});
      }
    }
  }

  /** Counts a drive that led to no edge; closes the direction after some. */
  void giveUp()
  {
    ExplorerState &state = m_step.state;
    if (state.origin && state.direction &&
        ++state.attempts[{*state.origin, *state.direction}] >= m_options.directionTries) {
      settle(DirectionState::Closed,
             "given up after " + std::to_string(m_options.directionTries) + " drives");
    }
  }

  bool tooOftenInVain(NodeId node) const
  {
    const auto count = m_step.state.vain.find(node);
    return count != m_step.state.vain.end() && count->second > 1;
  }

  /** Whether what was driven is short enough to stand for a way. */
  bool isWay(const Chord &chord) const
  {
    const bool near =
        chord.distance <= m_options.nearEdge() && chord.travelled <= m_options.longestDetour();
    return chord.travelled <= m_options.longestEdge() || near;
  }

  /** How far the node lies from where the robot stands, by the ways driven. */
  std::optional<Offset> offset(NodeId node) const
  {
    const ExplorerState &state = m_step.state;
    const auto there =
        state.origin ? reckon(m_map, *state.origin, node) : std::optional<Reckoned>{};
    if (!there) {
      return std::nullopt;
    }
    const Chord &chord = state.chord;
    const Eigen::Vector2d here(chord.distance * std::cos(chord.bearingAtOrigin),
                               chord.distance * std::sin(chord.bearingAtOrigin));
    return Offset{(there->fromMto.translation() - here).norm(),
                  m_options.reckoningError * there->length};
  }

  /** Whether the node can stand within `reach` metres of the robot. */
  bool plausible(NodeId node, double reach) const
  {
    const auto off = offset(node);
    return !off || off->distance <= reach + 2.0 * off->error;
  }

  /** Logarithm of the odds that the robot is at the place, by sight and by the ways driven. */
  double logOdds(const PlaceMatch &match) const
  {
    constexpr double kSurest = 0.99; // views are not surer, however alike
    const double probability = std::min(match.probability, kSurest);
    const double sight = std::log(probability / (1.0 - probability));
    const auto off = offset(match.node);
    const double sigmas = off ? off->distance / (m_options.placeSigma + off->error) : 0.0;
    return sight - 0.5 * sigmas * sigmas;
  }

  /** Whether the node stands right here by ways that are short enough to tell. */
  bool standsHere(NodeId node) const
  {
    const auto off = offset(node);
    return off && off->error <= m_options.surelyBeyond && off->distance <= m_options.rightHere;
  }

  /**
   * The known place that the robot most probably is at; nullptr if that is not likely enough.
   * @param near only those but the origin that stand right here by the ways; sight may doubt them
   */
  const PlaceMatch *placeHere(const std::vector<PlaceMatch> &matches, bool near) const
  {
    const PlaceMatch *best = nullptr;
    double highest = near ? m_options.leastNear : m_options.leastLogOdds;
    for (const PlaceMatch &match : matches) {
      const double odds = logOdds(match);
      if (odds > highest && !tooOftenInVain(match.node) &&
          (!near || (match.node != m_step.state.origin && standsHere(match.node)))) {
        highest = odds;
        best = &match;
      }
    }
    return best;
  }

  /** Records the way from the node left to `node`, where the robot now stands. */
  void connect(NodeId node, const Chord &chord)
  {
    const ExplorerState &state = m_step.state;
    if (!state.origin || *state.origin == node) {
      return;
    }
    const NodeId origin = *state.origin;
    if (!isWay(chord)) {
      giveUp();
      return;
    }
    settle(DirectionState::Driven, "led to node " + std::to_string(node.value));
    if (!m_map.edgeBetween(origin, node)) {
      change(EdgeAdded{Edge{m_map.nextEdgeId(), origin, node, chord.bearingAtOrigin,
                            chord.bearingAtHere, chord.distance}});
    }
    settleAlong(origin, chord.bearingAtOrigin, node);
    settleAlong(node, chord.bearingAtHere, origin);
  }

  void leave(NodeId node)
  {
    ExplorerState &state = m_step.state;
    const bool again = state.origin == node && state.phase == Phase::Returning;
    state.origin = node;
    state.chord = {};
    state.direction.reset();
    state.target.reset();
    state.route.clear();
    state.retries = 0;
    state.retreated = false;
    if (tooManyNodes()) {
      end();
      return;
    }
    closeKnown(node);
    for (const Direction &direction : m_map.node(node).directions) {
      if (direction.state == DirectionState::Open) {
        state.direction = direction.id;
        if (!again) {
          state.vain.clear();
        }
        ask(Phase::Driving, drive(direction));
        return;
      }
    }
    plan(node);
  }

  std::optional<std::vector<NodeId>> pathToOpen(NodeId node) const
  {
    return overSoundEdges(m_step.state.failures, m_options.legTries * (1 + m_step.state.stranded),
                          [&](const std::set<EdgeId> &blocked) {
                            return pathToNearestOpen(m_map, node, blocked, m_options.cost);
                          });
  }

  void plan(NodeId node)
  {
    ExplorerState &state = m_step.state;
    const auto path = pathToOpen(node);
    if (!path) {
      if (m_map.openDirectionCount() > 0 && state.stranded < m_options.rescueTries) {
        ++state.stranded;
        state.retries = 0;
        ask(Phase::Relocating, Recognise{});
        return;
      }
      closeUnreachable();
      end();
      return;
    }
    state.stranded = 0;
    m_step.log.push_back(routeLine("Path planning", *path));
    state.route.assign(path->begin() + 1, path->end());
    followRoute();
  }

  /** So that whoever reads the map knows why nobody has driven there. */
  void closeUnreachable()
  {
    const auto nodes = m_map.nodes();
    for (const auto &[id, node] : nodes) {
      for (const Direction &direction : node.directions) {
        if (direction.state == DirectionState::Open) {
          change(DirectionSettled{id, direction.id, DirectionState::Closed, "unreachable"});
        }
      }
    }
  }

  /** Closes the directions of the node stood at that lead to where there is a node already. */
  void closeKnown(NodeId node)
  {
    if (m_options.closeNear <= 0.0) {
      return;
    }
    const std::vector<Direction> directions = m_map.node(node).directions;
    for (const Direction &direction : directions) {
      const auto known = direction.state == DirectionState::Open
                             ? nodeWhere(node, direction.bearing)
                             : std::nullopt;
      if (known) {
        change(DirectionSettled{node, direction.id, DirectionState::Closed,
                                "node " + std::to_string(known->value) + " is there"});
      }
    }
  }

  /** The node where a drive from `node` would end, by ways short enough to be sure of it. */
  std::optional<NodeId> nodeWhere(NodeId node, double bearing) const
  {
    const Eigen::Vector2d end =
        m_options.forwardDistance * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    for (const auto &[other, unused] : m_map.nodes()) {
      const auto there = other == node ? std::nullopt : reckon(m_map, node, other);
      if (there && m_options.reckoningError * there->length < m_options.surelyBeyond &&
          (there->fromMto.translation() - end).norm() < m_options.closeNear) {
        return other;
      }
    }
    return std::nullopt;
  }

  void followRoute()
  {
    ExplorerState &state = m_step.state;
    state.strode = false;
    if (const auto drive = stride()) {
      ask(Phase::Striding, *drive);
      return;
    }
    const NodeId next = state.route.front();
    home(Phase::Following, next, m_map.departureBearing(*state.origin, next));
  }

  const ExplorerOptions &m_options;
  TopologicalMap m_map;
  Step<ExplorerState> m_step;
};

} // namespace

Explorer::Explorer(const ExplorerOptions &options) : m_options(options)
{
  if (!(options.forwardDistance > 0.0)) {
    throw LogicError("forwardDistance must be positive, not " +
                     std::to_string(options.forwardDistance));
  }
}

Step<ExplorerState> Explorer::start(const TopologicalMap &map) const
{
  return resume(ExplorerState{}, map);
}

Step<ExplorerState> Explorer::resume(const State &state, const TopologicalMap &map) const
{
  Stepper stepper(m_options, state, map);
  stepper.begin();
  return stepper.take();
}

Command Explorer::pending(const State &state, const TopologicalMap &map) const
{
  return Stepper(m_options, state, map).pending();
}

Step<ExplorerState> Explorer::next(const State &state, const TopologicalMap &map,
                                   const Report &report) const
{
  Stepper stepper(m_options, state, map);
  if (std::holds_alternative<Interrupted>(report)) {
    stepper.interrupt();
    return stepper.take();
  }
  switch (state.phase) {
  case Phase::Surveying:
    stepper.surveyed(answer<Surveyed>(report));
    break;
  case Phase::Driving:
    stepper.driven(answer<Driven>(report));
    break;
  case Phase::Classifying:
    stepper.classified(answer<Recognised>(report));
    break;
  case Phase::Homing:
    stepper.homed(answer<Homed>(report));
    break;
  case Phase::Following:
    stepper.followed(answer<Homed>(report));
    break;
  case Phase::Striding:
    stepper.strode(answer<Driven>(report));
    break;
  case Phase::Retreating:
    stepper.retreated(answer<Driven>(report));
    break;
  case Phase::Relocating:
    stepper.relocated(answer<Recognised>(report));
    break;
  case Phase::Returning:
    stepper.returned(answer<Homed>(report));
    break;
  case Phase::Finished:
    throw LogicError("the exploration has finished; no report can follow");
  }
  return stepper.take();
}

} // namespace homeward
