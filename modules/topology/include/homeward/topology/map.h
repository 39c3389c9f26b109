// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace homeward
{

/** What became of a way to leave a place. */
enum class DirectionState
{
  Open,   ///< nobody has driven there yet
  Driven, ///< an edge leaves that way, or the robot came from there
  Closed  ///< given up; Direction::reason says why
};

/** "open", "driven" or "closed". */
std::string_view name(DirectionState state);

/** Inverse of name(); nothing for any other word. */
std::optional<DirectionState> parseDirectionState(std::string_view word);

/** A way to leave a place. */
struct Direction
{
  DirectionId id;       ///< its index in Node::directions
  double bearing = 0.0; ///< radians, ccw from the robot's heading when the node was created
  double width = 0.0;   ///< radians, 0 or more
  DirectionState state = DirectionState::Open;
  std::string reason = {}; ///< why it was settled; empty while open

  bool operator==(const Direction &) const = default;
};

/** A place. */
struct Node
{
  NodeId id;
  std::vector<Direction> directions = {};

  bool operator==(const Node &) const = default;
};

/** Two places with a driven way between them, usable both ways. */
struct Edge
{
  EdgeId id;
  NodeId a;
  NodeId b;
  /** Departure bearing towards the other end, radians ccw from that node's stored heading. */
  std::optional<double> bearingAtA = std::nullopt;
  std::optional<double> bearingAtB = std::nullopt; ///< as bearingAtA, at b towards a
  std::optional<double> length = std::nullopt;     ///< metres, straight, as odometry had it

  bool operator==(const Edge &) const = default;
};

/** A place is added; its id is TopologicalMap::nextNodeId(), its directions' ids count from 0. */
struct NodeAdded
{
  Node node;
};

/** A way is added; its id is TopologicalMap::nextEdgeId(). */
struct EdgeAdded
{
  Edge edge;
};

/** An open direction becomes driven or closed, once and for good. */
struct DirectionSettled
{
  NodeId node;
  DirectionId direction;
  DirectionState state = DirectionState::Closed;
  std::string reason = {};
};

/** One step in the growth of a map. */
using MapChange = std::variant<NodeAdded, EdgeAdded, DirectionSettled>;

/**
 * The topological map: places, the ways between them, and the ways not tried yet. A value without
 * images or coordinates. It grows by apply() alone, so that it always holds:
 * - ids count from 0 in the order of arrival and are never reused;
 * - every edge joins two known, different nodes, and no two edges join the same two;
 * - bearings, widths and lengths are finite, widths and lengths not negative;
 * - a settled direction stays as it is.
 */
class TopologicalMap
{
public:
  /** The id that the next node must have. */
  NodeId nextNodeId() const;

  /** The id that the next edge must have. */
  EdgeId nextEdgeId() const;

  const std::map<NodeId, Node> &nodes() const { return m_nodes; }
  const std::map<EdgeId, Edge> &edges() const { return m_edges; }

  /** Whether the node exists. */
  bool contains(NodeId id) const { return m_nodes.count(id) != 0; }

  /** @throw LogicError when the node is unknown */
  const Node &node(NodeId id) const;

  /** The nodes one edge away, smallest id first. @throw LogicError when the node is unknown */
  const std::vector<NodeId> &neighbours(NodeId id) const;

  /** The edge that joins two nodes, given either way round. @throw LogicError for unknown nodes */
  std::optional<Edge> edgeBetween(NodeId a, NodeId b) const;

  /**
   * Departure bearing at `from` along its edge to `to`, radians ccw from the stored heading of
   * `from`; nothing without such an edge or when the edge does not know it.
   * @throw LogicError for unknown nodes
   */
  std::optional<double> departureBearing(NodeId from, NodeId to) const;

  /** Whether the node has a direction that nobody has driven. @throw LogicError when unknown */
  bool hasOpenDirection(NodeId id) const;

  /** Number of open directions of the whole map. */
  int openDirectionCount() const;

  /**
   * Grows the map.
   * @throw LogicError naming the value that breaks a rule; the map then is as before
   */
  void apply(const MapChange &change);

  bool operator==(const TopologicalMap &) const = default;

private:
  void add(const NodeAdded &change);
  void add(const EdgeAdded &change);
  void add(const DirectionSettled &change);

  std::map<NodeId, Node> m_nodes;
  std::map<EdgeId, Edge> m_edges;
  std::map<NodeId, std::vector<NodeId>> m_neighbours; ///< sorted
};

} // namespace homeward
