// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_checks.h"

#include <homeward/core/angle.h>
#include <homeward/topology/map.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{

namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int countOpen(const std::vector<Direction> &directions)
{
  return static_cast<int>(
      std::count_if(directions.begin(), directions.end(), [](const Direction &direction) {
        return direction.state == DirectionState::Open;
      }));
}

std::optional<double> turned(const std::optional<double> &bearing, double turn)
{
  return bearing ? std::optional(wrapAngle(*bearing + turn)) : std::nullopt;
}

EdgeStatistics sum(const EdgeStatistics &a, const EdgeStatistics &b)
{
  if (a.tries == 0 || b.tries == 0) {
    return a.tries == 0 ? b : a;
  }
  const EdgeStatistics &later = b.lastTime > a.lastTime ? b : a;
  const EdgeStatistics &earlier = b.lastTime > a.lastTime ? a : b;
  EdgeStatistics both = later;
  both.tries = a.tries + b.tries;
  both.successes = a.successes + b.successes;
  if (both.successes > 0) {
    both.meanSeconds = (a.successes * a.meanSeconds + b.successes * b.meanSeconds) / both.successes;
  }
  if (both.lastError.empty()) {
    both.lastError = earlier.lastError;
  }
  return both;
}

} // namespace

void TopologicalMap::apply(const MapChange &change)
{
  std::visit([this](const auto &one) { make(one); }, change);
}

void TopologicalMap::checkName(NodeId id, const std::string &name) const
{
  checkNameText(id, name);
  const auto other = m_named.find(name);
  if (other != m_named.end() && other->second != id) {
    refuse("the name \"" + name + "\" for " + text(id) + " is that of " + text(other->second));
  }
}

void TopologicalMap::rename(NodeId id, const std::string &name)
{
  Node &node = m_nodes.at(id);
  m_named.erase(node.name);
  node.name = name;
  if (!name.empty()) {
    m_named.emplace(name, id);
  }
}

void TopologicalMap::checkEnds(const Edge &edge) const
{
  if (edge.a == edge.b) {
    refuse(text(edge.id) + " joins " + text(edge.a) + " to itself");
  }
  if (const std::optional<EdgeId> known = edgeIdBetween(edge.a, edge.b)) {
    refuse(text(edge.id) + ": " + text(edge.a) + " and " + text(edge.b) +
           " are already joined by " + text(*known));
  }
}

void TopologicalMap::link(EdgeId id)
{
  const Edge &edge = m_edges.at(id);
  for (const auto &[from, to] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
    std::vector<Link> &links = m_junctions.at(from).links;
    links.insert(place(links, to), {to, id, edge.forbidden ? kInfinity : expectedMetres(edge)});
  }
}

void TopologicalMap::unlink(EdgeId id)
{
  const Edge &edge = m_edges.at(id);
  for (const auto &[from, to] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
    std::vector<Link> &links = m_junctions.at(from).links;
    links.erase(place(links, to));
  }
}

/** An edge that was changed in any way but its id. */
void TopologicalMap::replace(const Edge &edge)
{
  unlink(edge.id);
  m_edges.at(edge.id) = edge;
  link(edge.id);
}

void TopologicalMap::make(const NodeAdded &change)
{
  const Node &node = change.node;
  if (node.id != nextNodeId()) {
    refuse(text(node.id) + " cannot be added: the next id is " +
           std::to_string(nextNodeId().value));
  }
  checkDirections(node);
  checkName(node.id, node.name);
  m_nodes.add(node);
  m_junctions.add({countOpen(node.directions)});
  rename(node.id, node.name);
}

void TopologicalMap::make(const EdgeAdded &change)
{
  const Edge &edge = change.edge;
  if (edge.id != nextEdgeId()) {
    refuse(text(edge.id) + " cannot be added: the next id is " +
           std::to_string(nextEdgeId().value));
  }
  checkEnds(edge);
  checkValues(edge);
  m_edges.add(edge);
  link(edge.id);
}

void TopologicalMap::make(const DirectionSettled &change)
{
  const auto index = static_cast<std::size_t>(change.direction.value);
  if (index >= node(change.node).directions.size()) {
    refuse(text(change.node, change.direction) + " is unknown");
  }
  Direction &direction = m_nodes.at(change.node).directions[index];
  if (change.state == DirectionState::Open) {
    refuse(text(change.node, change.direction) + " cannot be settled as open");
  }
  if (direction.state != DirectionState::Open) {
    refuse(text(change.node, change.direction) + " is already " +
           std::string(name(direction.state)));
  }
  direction.state = change.state;
  direction.reason = change.reason;
  --m_junctions.at(change.node).openDirections;
}

void TopologicalMap::make(const NodeNamed &change)
{
  node(change.node);
  checkName(change.node, change.name);
  rename(change.node, change.name);
}

void TopologicalMap::make(const NodeRemoved &change)
{
  node(change.node);
  const std::vector<Link> links = this->links(change.node);
  for (const Link &link : links) {
    make(EdgeRemoved{link.edge});
  }
  rename(change.node, "");
  m_nodes.remove(change.node);
  m_junctions.remove(change.node);
}

void TopologicalMap::make(const EdgeRemoved &change)
{
  edge(change.edge);
  unlink(change.edge);
  m_edges.remove(change.edge);
}

void TopologicalMap::make(const EdgeForbidden &change)
{
  Edge changed = edge(change.edge);
  changed.forbidden = change.forbidden;
  replace(changed);
}

void TopologicalMap::make(const EdgeTried &change)
{
  Edge tried = edge(change.edge);
  EdgeStatistics &statistics = tried.statistics;
  ++statistics.tries;
  statistics.lastTime = change.time;
  if (!(std::isfinite(change.seconds) && change.seconds >= 0.0)) {
    refuse(text(change.edge) + ": " + std::to_string(change.seconds) + " s are no duration");
  }
  if (change.end.empty()) {
    ++statistics.successes;
    statistics.meanSeconds += (change.seconds - statistics.meanSeconds) / statistics.successes;
  }
  else {
    statistics.lastError = change.end;
  }
  checkStatistics(change.edge, statistics);
  replace(tried);
}

void TopologicalMap::make(const NodesMerged &change)
{
  node(change.kept);
  const std::string name = node(change.gone).name;
  if (change.kept == change.gone) {
    refuse(text(change.kept) + " cannot be merged with itself");
  }
  if (!std::isfinite(change.turn)) {
    refuse("the turn " + std::to_string(change.turn) + " of " + text(change.gone) +
           " is not finite");
  }
  const std::vector<Link> links = this->links(change.gone);
  for (const Link &link : links) {
    takeOver(link.edge, change);
  }
  make(NodeRemoved{change.gone});
  if (node(change.kept).name.empty()) {
    rename(change.kept, name);
  }
}

void TopologicalMap::takeOver(EdgeId id, const NodesMerged &merge)
{
  Edge moved = edge(id);
  const bool goneIsA = moved.a == merge.gone;
  const NodeId third = goneIsA ? moved.b : moved.a;
  if (third == merge.kept) {
    return; // goes with the node
  }
  if (const std::optional<EdgeId> known = edgeIdBetween(merge.kept, third)) {
    Edge stays = edge(*known);
    stays.statistics = sum(stays.statistics, moved.statistics);
    stays.forbidden = stays.forbidden || moved.forbidden;
    replace(stays);
    return; // goes with the node
  }
  std::optional<double> &bearing = goneIsA ? moved.bearingAtA : moved.bearingAtB;
  bearing = turned(bearing, merge.turn);
  (goneIsA ? moved.a : moved.b) = merge.kept;
  replace(moved);
  for (Direction &direction : m_nodes.at(merge.kept).directions) {
    if (bearing && direction.state == DirectionState::Open &&
        std::abs(wrapAngle(direction.bearing - *bearing)) < kTakenOver) {
      direction.state = DirectionState::Driven;
      direction.reason = "leads to " + text(third);
      --m_junctions.at(merge.kept).openDirections;
    }
  }
}

} // namespace homeward
