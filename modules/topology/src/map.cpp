// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/topology/map.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

[[noreturn]] void refuse(const std::string &what)
{
  throw LogicError("topological map: " + what);
}

std::string text(NodeId id)
{
  return "node " + std::to_string(id.value);
}

std::string text(EdgeId id)
{
  return "edge " + std::to_string(id.value);
}

std::string text(NodeId node, DirectionId id)
{
  return "direction " + std::to_string(id.value) + " of " + text(node);
}

void checkDirections(const Node &node)
{
  for (std::size_t i = 0; i < node.directions.size(); ++i) {
    const Direction &direction = node.directions[i];
    if (direction.id.value != static_cast<std::int64_t>(i)) {
      refuse(text(node.id, direction.id) + ": the next id is " + std::to_string(i));
    }
    if (!std::isfinite(direction.bearing)) {
      refuse(text(node.id, direction.id) + ": bearing " + std::to_string(direction.bearing) +
             " is not finite");
    }
    if (!std::isfinite(direction.width) || direction.width < 0.0) {
      refuse(text(node.id, direction.id) + ": width " + std::to_string(direction.width) +
             " is not a finite angle of 0 or more");
    }
  }
}

void checkBearing(EdgeId id, const std::optional<double> &bearing)
{
  if (bearing && !std::isfinite(*bearing)) {
    refuse(text(id) + ": bearing " + std::to_string(*bearing) + " is not finite");
  }
}

void checkLength(EdgeId id, const std::optional<double> &length)
{
  if (length && !(std::isfinite(*length) && *length >= 0.0)) {
    refuse(text(id) + ": length " + std::to_string(*length) + " is none");
  }
}

void insertSorted(std::vector<NodeId> &ids, NodeId id)
{
  ids.insert(std::lower_bound(ids.begin(), ids.end(), id), id);
}

bool isOpen(const Direction &direction)
{
  return direction.state == DirectionState::Open;
}

} // namespace

std::string_view name(DirectionState state)
{
  switch (state) {
  case DirectionState::Open:
    return "open";
  case DirectionState::Driven:
    return "driven";
  case DirectionState::Closed:
    return "closed";
  }
  refuse("direction state " + std::to_string(static_cast<int>(state)) + " does not exist");
}

std::optional<DirectionState> parseDirectionState(std::string_view word)
{
  for (const DirectionState state :
       {DirectionState::Open, DirectionState::Driven, DirectionState::Closed}) {
    if (word == name(state)) {
      return state;
    }
  }
  return std::nullopt;
}

NodeId TopologicalMap::nextNodeId() const
{
  return {static_cast<std::int64_t>(m_nodes.size())};
}

EdgeId TopologicalMap::nextEdgeId() const
{
  return {static_cast<std::int64_t>(m_edges.size())};
}

const Node &TopologicalMap::node(NodeId id) const
{
  const auto found = m_nodes.find(id);
  if (found == m_nodes.end()) {
    refuse(text(id) + " is unknown");
  }
  return found->second;
}

const std::vector<NodeId> &TopologicalMap::neighbours(NodeId id) const
{
  const auto found = m_neighbours.find(id);
  if (found == m_neighbours.end()) {
    refuse(text(id) + " is unknown");
  }
  return found->second;
}

std::optional<Edge> TopologicalMap::edgeBetween(NodeId a, NodeId b) const
{
  node(b);
  const std::vector<NodeId> &near = neighbours(a);
  if (!std::binary_search(near.begin(), near.end(), b)) {
    return std::nullopt;
  }
  const auto found = std::find_if(m_edges.begin(), m_edges.end(), [&](const auto &entry) {
    const Edge &edge = entry.second;
    return (edge.a == a && edge.b == b) || (edge.a == b && edge.b == a);
  });
  return found->second;
}

std::optional<double> TopologicalMap::departureBearing(NodeId from, NodeId to) const
{
  const std::optional<Edge> edge = edgeBetween(from, to);
  if (!edge) {
    return std::nullopt;
  }
  return edge->a == from ? edge->bearingAtA : edge->bearingAtB;
}

bool TopologicalMap::hasOpenDirection(NodeId id) const
{
  const std::vector<Direction> &directions = node(id).directions;
  return std::any_of(directions.begin(), directions.end(), isOpen);
}

int TopologicalMap::openDirectionCount() const
{
  std::ptrdiff_t count = 0;
  for (const auto &[id, place] : m_nodes) {
    count += std::count_if(place.directions.begin(), place.directions.end(), isOpen);
  }
  return static_cast<int>(count);
}

void TopologicalMap::apply(const MapChange &change)
{
  std::visit([this](const auto &one) { add(one); }, change);
}

void TopologicalMap::add(const NodeAdded &change)
{
  const Node &node = change.node;
  if (node.id != nextNodeId()) {
    refuse(text(node.id) + " cannot be added: the next id is " +
           std::to_string(nextNodeId().value));
  }
  checkDirections(node);
  m_nodes.emplace(node.id, node);
  m_neighbours.emplace(node.id, std::vector<NodeId>{});
}

void TopologicalMap::add(const EdgeAdded &change)
{
  const Edge &edge = change.edge;
  if (edge.id != nextEdgeId()) {
    refuse(text(edge.id) + " cannot be added: the next id is " +
           std::to_string(nextEdgeId().value));
  }
  if (edge.a == edge.b) {
    refuse(text(edge.id) + " joins " + text(edge.a) + " to itself");
  }
  if (const std::optional<Edge> known = edgeBetween(edge.a, edge.b)) {
    refuse(text(edge.id) + ": " + text(edge.a) + " and " + text(edge.b) +
           " are already joined by " + text(known->id));
  }
  checkBearing(edge.id, edge.bearingAtA);
  checkBearing(edge.id, edge.bearingAtB);
  checkLength(edge.id, edge.length);
  m_edges.emplace(edge.id, edge);
  insertSorted(m_neighbours.at(edge.a), edge.b);
  insertSorted(m_neighbours.at(edge.b), edge.a);
}

void TopologicalMap::add(const DirectionSettled &change)
{
  const auto index = static_cast<std::size_t>(change.direction.value);
  if (index >= node(change.node).directions.size()) {
    refuse(text(change.node, change.direction) + " is unknown");
  }
  Direction &direction = m_nodes.at(change.node).directions[index];
  if (change.state == DirectionState::Open) {
    refuse(text(change.node, change.direction) + " cannot be settled as open");
  }
  if (!isOpen(direction)) {
    refuse(text(change.node, change.direction) + " is already " +
           std::string(name(direction.state)));
  }
  direction.state = change.state;
  direction.reason = change.reason;
}

} // namespace homeward
