// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_checks.h"

#include <homeward/topology/map.h>

#include <algorithm>
#include <charconv>

namespace homeward
{

namespace
{

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

TopologicalMap::TopologicalMap(const std::vector<Node> &nodes, const std::vector<Edge> &edges,
                               NodeId nextNode, EdgeId nextEdge)
{
  const auto reserve = [](auto &values, auto id, auto next) {
    if (id < values.next() || !(id < next)) {
      refuse(text(id) + " is out of order; the next id is " + std::to_string(next.value));
    }
    values.skipTo(id);
  };
  for (const Node &node : nodes) {
    reserve(m_nodes, node.id, nextNode);
    m_ways.skipTo(node.id);
    make(NodeAdded{node});
  }
  for (const Edge &edge : edges) {
    reserve(m_edges, edge.id, nextEdge);
    make(EdgeAdded{edge});
  }
  m_nodes.skipTo(nextNode);
  m_ways.skipTo(nextNode);
  m_edges.skipTo(nextEdge);
}

const Node &TopologicalMap::node(NodeId id) const
{
  const Node *found = m_nodes.find(id);
  if (found == nullptr) {
    refuse(text(id) + " is unknown");
  }
  return *found;
}

const Edge &TopologicalMap::edge(EdgeId id) const
{
  const Edge *found = m_edges.find(id);
  if (found == nullptr) {
    refuse(text(id) + " is unknown");
  }
  return *found;
}

std::optional<NodeId> TopologicalMap::find(std::string_view numberOrName) const
{
  if (const auto named = m_named.find(numberOrName); named != m_named.end()) {
    return named->second;
  }
  NodeId number;
  const char *end = numberOrName.data() + numberOrName.size();
  const auto read = std::from_chars(numberOrName.data(), end, number.value);
  const bool isNumber = read.ec == std::errc() && read.ptr == end;
  return isNumber && contains(number) ? std::optional(number) : std::nullopt;
}

const TopologicalMap::Ways &TopologicalMap::ways(NodeId id) const
{
  const Ways *found = m_ways.find(id);
  if (found == nullptr) {
    refuse(text(id) + " is unknown");
  }
  return *found;
}

const std::vector<NodeId> &TopologicalMap::neighbours(NodeId id) const
{
  return ways(id).neighbours;
}

const std::vector<EdgeId> &TopologicalMap::edgesAt(NodeId id) const
{
  return ways(id).edges;
}

std::optional<EdgeId> TopologicalMap::edgeIdBetween(NodeId a, NodeId b) const
{
  node(b);
  const Ways &near = ways(a);
  const auto place = std::lower_bound(near.neighbours.begin(), near.neighbours.end(), b);
  if (place == near.neighbours.end() || *place != b) {
    return std::nullopt;
  }
  return near.edges[static_cast<std::size_t>(place - near.neighbours.begin())];
}

std::optional<Edge> TopologicalMap::edgeBetween(NodeId a, NodeId b) const
{
  const std::optional<EdgeId> id = edgeIdBetween(a, b);
  return id ? std::optional(edge(*id)) : std::nullopt;
}

std::optional<double> TopologicalMap::departureBearing(NodeId from, NodeId to) const
{
  const std::optional<EdgeId> id = edgeIdBetween(from, to);
  if (!id) {
    return std::nullopt;
  }
  return edge(*id).a == from ? edge(*id).bearingAtA : edge(*id).bearingAtB;
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

} // namespace homeward
