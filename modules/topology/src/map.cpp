// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_checks.h"

#include <homeward/topology/map.h>

#include <algorithm>
#include <charconv>

namespace homeward
{

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

double expectedMetres(const Edge &edge)
{
  constexpr double kUnknown = 2.0;
  constexpr double kLeast = 0.1;
  constexpr double kMost = 1e6; // a sum of millions still tells kLeast
  const EdgeStatistics &known = edge.statistics;
  const double length = std::max(edge.length.value_or(kUnknown), kLeast);
  return std::min(length * (known.tries + 1.0) / (known.successes + 1.0), kMost);
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
    m_junctions.skipTo(node.id);
    make(NodeAdded{node});
  }
  for (const Edge &edge : edges) {
    reserve(m_edges, edge.id, nextEdge);
    make(EdgeAdded{edge});
  }
  m_nodes.skipTo(nextNode);
  m_junctions.skipTo(nextNode);
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

const TopologicalMap::Junction &TopologicalMap::junction(NodeId id) const
{
  const Junction *found = m_junctions.find(id);
  if (found == nullptr) {
    refuse(text(id) + " is unknown");
  }
  return *found;
}

std::vector<NodeId> TopologicalMap::neighbours(NodeId id) const
{
  std::vector<NodeId> near;
  for (const Link &link : links(id)) {
    near.push_back(link.to);
  }
  return near;
}

/** Of the link to a node, or where it would stand. */
std::vector<Link>::const_iterator TopologicalMap::place(const std::vector<Link> &links, NodeId to)
{
  return std::lower_bound(links.begin(), links.end(), to,
                          [](const Link &link, NodeId end) { return link.to < end; });
}

std::optional<EdgeId> TopologicalMap::edgeIdBetween(NodeId a, NodeId b) const
{
  node(b);
  const auto link = place(links(a), b);
  return link != links(a).end() && link->to == b ? std::optional(link->edge) : std::nullopt;
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

int TopologicalMap::openDirectionCount() const
{
  int count = 0;
  for (const auto &[id, junction] : m_junctions) {
    count += junction.openDirections;
  }
  return count;
}

} // namespace homeward
