// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "explorer_commands.h"
#include "explorer_whereabouts.h"
#include "mission_words.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/mission/explorer.h>

#include <cmath>
#include <utility>

namespace homeward
{

/** One step in the making: a copy of the state and of the map that grows with the changes. */
class ExplorerStepper
{
  using Phase = ExplorerState::Phase;

public:
  ExplorerStepper(const ExplorerOptions &options, const ExplorerState &state,
                  const TopologicalMap &map)
      : m_options(options), m_map(map), m_step{state, Finish{}, {}, {}},
        m_whereabouts(options, m_map, m_step.state), m_commands(options, m_map, m_step.state)
  {
    ++m_step.state.steps;
  }

  ExplorerStepper(const ExplorerStepper &) = delete;
  ExplorerStepper &operator=(const ExplorerStepper &) = delete;

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
    for (const NodeId other : m_step.state.refuted) {
      m_step.state.alike.emplace_back(node, other);
    }
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
      if (report.chord.distance + report.seenAhead < m_options.newcomer()) {
        giveUp();
      }
      else {
        settle(DirectionState::Closed, "too narrow");
      }
      m_step.state.direction.reset();
      home(Phase::Homing, *m_step.state.origin, std::nullopt);
      return;
    }
    ask(Phase::Classifying, Recognise{});
  }

  void classified(const Recognised &report)
  {
    const bool more = m_step.state.retries < m_options.homingTries;
    const PlaceMatch *known = more ? m_whereabouts.placeHere(report.matches, false) : nullptr;
    const bool unsure = known == nullptr;
    if (unsure && more) {
      known = m_whereabouts.placeHere(report.matches, true);
    }
    if (known == nullptr) {
      surveyOrGoBack(report.matches);
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
    const HomingEnd end = endOf(report);
    state.chord = report.chord;
    if (end == HomingEnd::Arrived) {
      if (state.direction && state.origin) {
        m_step.log.push_back(
            explorationLine("Exploration(Homing)", *state.origin, target, state.dissimilarity));
      }
      connect(target, report.chord);
      leave(target);
    }
    else {
      ++state.retries;
      state.vain[target] += end == HomingEnd::Lost ? kLooksAlike : 1;
      ask(Phase::Classifying, Recognise{});
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
      state.refuted.clear();
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
      return m_whereabouts.onlyLooksLike(match.node) ||
             !m_whereabouts.plausible(match.node, m_options.nearPlace);
    });
    if (state.stranded > 0) {
      std::erase_if(matches,
                    [this](const PlaceMatch &match) { return !m_commands.pathToOpen(match.node); });
    }
    const std::optional<NodeId> place = likeliestPlace(notInVain(matches, state.vain, 1));
    const bool tried = state.retries++ > 1;
    if (place && !tried) {
      home(Phase::Returning, *place, std::nullopt);
    }
    else if (state.stranded > 0) {
      plan(*state.origin);
    }
    else if (const auto back = state.retreated ? std::nullopt : m_commands.retreat()) {
      state.retreated = true;
      ask(Phase::Retreating, *back);
    }
    else if (state.origin && m_whereabouts.crowding() == state.origin) {
      leave(NodeId{*state.origin});
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
    if (endOf(report) == HomingEnd::Arrived) {
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

  void interrupt()
  {
    --m_step.state.steps;
    m_step.command = Finish{Outcome::Stopped, "interrupted"};
  }

private:
  static constexpr int kLooksAlike = 2; ///< homings in vain that one that ended "lost" counts as

  void ask(Phase phase, const Command &command)
  {
    m_step.state.phase = phase;
    m_step.command = command;
  }

  void survey() { ask(Phase::Surveying, Survey{}); }

  /** A place that no edge would lead to is none, nor is one where another stands. */
  void surveyOrGoBack(const std::vector<PlaceMatch> &matches)
  {
    ExplorerState &state = m_step.state;
    auto there = m_whereabouts.crowding();
    if (!there) {
      there = m_whereabouts.outOfReach(matches);
    }
    if (there) {
      settle(DirectionState::Closed, "node " + std::to_string(there->value) + " is there");
    }
    if (!state.origin || (m_whereabouts.isWay(state.chord) && !there)) {
      survey();
    }
    else if (const auto back = state.retreated ? std::nullopt : m_commands.retreat()) {
      state.retreated = true;
      ask(Phase::Retreating, *back);
    }
    else {
      home(Phase::Returning, *state.origin, std::nullopt);
    }
  }

  /** How the homing to the target ended; what it turned out to look like only is remembered. */
  HomingEnd endOf(const Homed &report)
  {
    ExplorerState &state = m_step.state;
    const NodeId target = *state.target;
    const bool elsewhere =
        report.end == HomingEnd::Arrived && m_whereabouts.isElsewhere(target, report.chord);
    if (elsewhere || report.end == HomingEnd::Lost) {
      state.refuted.push_back(target);
      return HomingEnd::Lost;
    }
    return report.end;
  }

  /** @param surely to make sure of the node, whatever the ways say */
  void home(Phase phase, NodeId node, std::optional<double> departure, bool surely = false)
  {
    ExplorerState &state = m_step.state;
    state.phase = phase;
    state.target = node;
    state.surely = surely;
    m_step.command = m_commands.homeTo(departure);
  }

  void end()
  {
    const Finish finish = m_commands.ending();
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

  /** Settles open directions of `node`. @param why takes one, returns the reason or nothing */
  template <class Why> void settleOpen(NodeId node, DirectionState to, const Why &why)
  {
    const std::vector<Direction> directions = m_map.node(node).directions;
    for (const Direction &direction : directions) {
      if (direction.state == DirectionState::Open) {
        if (const std::optional<std::string> reason = why(direction)) {
          change(DirectionSettled{node, direction.id, to, *reason});
        }
      }
    }
  }

  /** Settles the open directions of `node` that lead along a way already driven. */
  void settleAlong(NodeId node, double bearing, NodeId other)
  {
    settleOpen(node, DirectionState::Driven, [&](const Direction &direction) {
      const bool along = std::abs(wrapAngle(direction.bearing - bearing)) < m_options.settledAngle;
      return along ? std::optional("leads to node " + std::to_string(other.value)) : std::nullopt;
    });
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

  /** Records the way from the node left to `node`, where the robot now stands. */
  void connect(NodeId node, const Chord &chord)
  {
    const ExplorerState &state = m_step.state;
    if (!state.origin || *state.origin == node) {
      return;
    }
    const NodeId origin = *state.origin;
    if (!m_whereabouts.isWay(chord)) {
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
    state.refuted.clear();
    if (m_commands.tooManyNodes()) {
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
        ask(Phase::Driving, m_commands.drive(direction));
        return;
      }
    }
    plan(node);
  }

  void plan(NodeId node)
  {
    ExplorerState &state = m_step.state;
    const auto path = m_commands.pathToOpen(node);
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
    for (const auto &[id, unused] : nodes) {
      settleOpen(id, DirectionState::Closed,
                 [](const Direction &) { return std::optional<std::string>("unreachable"); });
    }
  }

  /** Closes the directions of the node stood at that lead to where there is a node already. */
  void closeKnown(NodeId node)
  {
    if (m_options.closeNear > 0.0) {
      settleOpen(node, DirectionState::Closed, [&](const Direction &direction) {
        const std::optional<NodeId> known = m_whereabouts.nodeWhere(node, direction.bearing);
        return known ? std::optional("node " + std::to_string(known->value) + " is there")
                     : std::nullopt;
      });
    }
  }

  void followRoute()
  {
    ExplorerState &state = m_step.state;
    state.strode = false;
    if (const auto drive = m_commands.stride()) {
      ask(Phase::Striding, *drive);
      return;
    }
    const NodeId next = state.route.front();
    home(Phase::Following, next, m_map.departureBearing(*state.origin, next));
  }

  const ExplorerOptions &m_options;
  TopologicalMap m_map;
  Step<ExplorerState> m_step;
  ExplorerWhereabouts m_whereabouts; ///< by this map and state
  ExplorerCommands m_commands;       ///< likewise
};

} // namespace homeward
