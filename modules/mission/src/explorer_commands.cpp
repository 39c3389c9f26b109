// SPDX-License-Identifier: GPL-3.0-or-later
#include "explorer_commands.h"

#include "mission_words.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

using Phase = ExplorerState::Phase;

/** What the phase cannot be without. */
template <class Id> Id named(const std::optional<Id> &id)
{
  if (!id) {
    throw LogicError("the exploration's state lacks what its phase needs");
  }
  return *id;
}

} // namespace

Command ExplorerCommands::pending() const
{
  switch (m_state.phase) {
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
    return homeTo(m_state.strode
                      ? std::nullopt
                      : m_map.departureBearing(named(m_state.origin), named(m_state.target)));
  case Phase::Striding:
    return named(stride());
  case Phase::Retreating:
    return named(retreat());
  case Phase::Finished:
    break;
  }
  return ending();
}

HomeTo ExplorerCommands::homeTo(std::optional<double> departure) const
{
  const NodeId node = named(m_state.target);
  const auto off = m_state.phase == Phase::Following ? std::optional(ExplorerWhereabouts::Offset{})
                                                     : m_whereabouts.offset(node);
  const bool far = !off || off->error > m_options.surelyBeyond;
  HomeTo command{node, departure, false, m_state.surely || far};
  if (!far && m_options.checksWays) {
    command.way = wayTo(node);
  }
  return command;
}

std::optional<Way> ExplorerCommands::wayTo(NodeId node) const
{
  const auto there = m_whereabouts.reckoned(node);
  if (!there) {
    return std::nullopt;
  }
  const Eigen::Vector2d way = there->fromMto.translation();
  return Way{std::atan2(way.y(), way.x()), way.norm()};
}

std::optional<DriveDirection> ExplorerCommands::retreat() const
{
  if (!m_options.retreats || !m_state.origin || m_state.chord.distance > m_options.longestEdge()) {
    return std::nullopt;
  }
  return DriveDirection{wrapAngle(m_state.chord.bearingAtOrigin + kPi), m_state.chord.distance};
}

std::optional<DriveDirection> ExplorerCommands::stride() const
{
  if (!m_options.strides || m_state.route.empty()) {
    return std::nullopt;
  }
  const NodeId origin = named(m_state.origin);
  const std::optional<double> departure = m_map.departureBearing(origin, m_state.route.front());
  const std::optional<Edge> edge = m_map.edgeBetween(origin, m_state.route.front());
  if (!departure || !edge->length || !m_state.failures.contains(edge->id)) {
    return std::nullopt;
  }
  return DriveDirection{*departure, *edge->length};
}

DriveDirection ExplorerCommands::drive(const Direction &direction) const
{
  return {direction.bearing, m_options.forwardDistance};
}

const Direction &ExplorerCommands::directionDriven() const
{
  const std::vector<Direction> &directions = m_map.node(named(m_state.origin)).directions;
  const DirectionId wanted = named(m_state.direction);
  const auto found = std::find_if(directions.begin(), directions.end(),
                                  [&](const Direction &each) { return each.id == wanted; });
  if (found == directions.end()) {
    throw LogicError("the exploration drives direction " + std::to_string(wanted.value) +
                     " of a node that has none such");
  }
  return *found;
}

std::optional<std::vector<NodeId>> ExplorerCommands::pathToOpen(NodeId node) const
{
  return overSoundEdges(m_state.failures, m_options.legTries * (1 + m_state.stranded),
                        [&](const std::set<EdgeId> &blocked) {
                          return pathToNearestOpen(m_map, node, blocked, m_options.cost);
                        });
}

bool ExplorerCommands::tooManyNodes() const
{
  return static_cast<int>(m_map.nodes().size()) > m_options.maxNodes;
}

Finish ExplorerCommands::ending() const
{
  if (tooManyNodes()) {
    return {Outcome::Failed, "the map has grown beyond " + std::to_string(m_options.maxNodes) +
                                 " nodes; places are not recognised again"};
  }
  return {Outcome::Done, "no reachable node has an open direction"};
}

} // namespace homeward
