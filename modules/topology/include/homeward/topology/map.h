// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/topology/id_map.h>
#include <homeward/topology/map_change.h>

#include <functional>
#include <map>

namespace homeward
{

/** An edge as seen from one of its ends, with what planning asks of it. */
struct Link
{
  NodeId to;           ///< its other end
  EdgeId edge;         ///< the way there
  double metres = 0.0; ///< expectedMetres() of the edge; infinite when it is forbidden

  bool operator==(const Link &) const = default;
};

/**
 * The topological map: places, the ways between them, and the ways not tried yet. A value without
 * images or coordinates. It changes by apply() alone, so that it always holds:
 * - ids count from 0 in the order of arrival and are never reused, whatever was removed;
 * - every edge joins two known, different nodes, and no two edges join the same two;
 * - bearings, widths, lengths and times are finite; widths, lengths and durations not negative;
 * - no edge has more successes than tries;
 * - a name is no number, has no control characters, and is that of one node;
 * - a settled direction stays as it is.
 *
 * A node, an edge and the links of a node are found by index.
 */
class TopologicalMap
{
public:
  TopologicalMap() = default;

  /**
   * A map that was kept elsewhere.
   * @param nodes, edges in order of ids
   * @param nextNode, nextEdge larger than every id that was ever given
   * @throw LogicError naming the value that breaks a rule
   */
  TopologicalMap(const std::vector<Node> &nodes, const std::vector<Edge> &edges, NodeId nextNode,
                 EdgeId nextEdge);

  /** The id that the next node must have. */
  NodeId nextNodeId() const { return m_nodes.next(); }

  /** The id that the next edge must have. */
  EdgeId nextEdgeId() const { return m_edges.next(); }

  /** All places, in order of ids. */
  const IdMap<NodeId, Node> &nodes() const { return m_nodes; }
  /** All ways, in order of ids. */
  const IdMap<EdgeId, Edge> &edges() const { return m_edges; }

  /** Whether the node exists. */
  bool contains(NodeId id) const { return m_nodes.contains(id); }

  /** @throw LogicError when the node is unknown */
  const Node &node(NodeId id) const;

  /** @throw LogicError when the edge is unknown */
  const Edge &edge(EdgeId id) const;

  /** The node that people mean by a number or a name; nothing when there is none. */
  std::optional<NodeId> find(std::string_view numberOrName) const;

  /** The edges at a node, by the id of the other end. @throw LogicError when it is unknown */
  const std::vector<Link> &links(NodeId id) const { return junction(id).links; }

  /** The other ends of links(). @throw LogicError when the node is unknown */
  std::vector<NodeId> neighbours(NodeId id) const;

  /** The edge that joins two nodes, given either way round. @throw LogicError for unknown nodes */
  std::optional<Edge> edgeBetween(NodeId a, NodeId b) const;

  /**
   * Departure bearing at `from` along its edge to `to`, radians ccw from the stored heading of
   * `from`; nothing without such an edge or when the edge does not know it.
   * @throw LogicError for unknown nodes
   */
  std::optional<double> departureBearing(NodeId from, NodeId to) const;

  /** Whether the node has a direction that nobody has driven. @throw LogicError when unknown */
  bool hasOpenDirection(NodeId id) const { return junction(id).openDirections > 0; }

  /** Number of open directions of the whole map. */
  int openDirectionCount() const;

  /**
   * Changes the map.
   * @throw LogicError naming the value that breaks a rule; the map then is as before
   */
  void apply(const MapChange &change);

  bool operator==(const TopologicalMap &) const = default;

private:
  /** What planning asks of a node: all of it here, so that it need not look at nodes and edges. */
  struct Junction
  {
    int openDirections = 0;
    std::vector<Link> links = {}; ///< sorted by the other end

    bool operator==(const Junction &) const = default;
  };

  void make(const NodeAdded &change);
  void make(const EdgeAdded &change);
  void make(const DirectionSettled &change);
  void make(const NodeNamed &change);
  void make(const NodeRemoved &change);
  void make(const EdgeRemoved &change);
  void make(const EdgeForbidden &change);
  void make(const EdgeTried &change);
  void make(const NodesMerged &change);

  void checkName(NodeId id, const std::string &name) const;
  void checkEnds(const Edge &edge) const;
  void rename(NodeId id, const std::string &name);
  const Junction &junction(NodeId id) const;
  std::optional<EdgeId> edgeIdBetween(NodeId a, NodeId b) const;
  void link(EdgeId id);
  void unlink(EdgeId id);
  void replace(const Edge &edge);
  static std::vector<Link>::const_iterator place(const std::vector<Link> &links, NodeId to);
  void takeOver(EdgeId id, const NodesMerged &merge);

  IdMap<NodeId, Node> m_nodes;
  IdMap<EdgeId, Edge> m_edges;
  IdMap<NodeId, Junction> m_junctions;
  std::map<std::string, NodeId, std::less<>> m_named;
};

} // namespace homeward
