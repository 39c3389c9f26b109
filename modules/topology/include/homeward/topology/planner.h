// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/topology/map.h>

#include <map>
#include <set>

namespace homeward
{

/** What is added up along a route. */
enum class RouteCost
{
  Edges,         ///< 1 for each edge
  ExpectedMetres ///< expectedMetres() of each edge
};

/**
 * The cheapest route, both ends included; of several, the one whose ids come first (compared place
 * by place). Forbidden edges are never used.
 * @param blocked more edges not to be used
 * @return nothing when no route exists; {from} when from equals to
 * @throw LogicError for unknown nodes
 */
std::optional<std::vector<NodeId>> shortestPath(const TopologicalMap &map, NodeId from, NodeId to,
                                                const std::set<EdgeId> &blocked = {},
                                                RouteCost cost = RouteCost::Edges);

/**
 * The cheapest route to the nearest node that has an open direction, both ends included; {from}
 * when that is `from` itself. Of nodes equally near, the smallest id. The search goes no further
 * than that node's distance. Forbidden edges are never used.
 * @param blocked more edges not to be used
 * @return nothing when no open direction can be reached
 * @throw LogicError when the node is unknown
 */
std::optional<std::vector<NodeId>> pathToNearestOpen(const TopologicalMap &map, NodeId from,
                                                     const std::set<EdgeId> &blocked = {},
                                                     RouteCost cost = RouteCost::Edges);

/**
 * Number of edges from `from` to every node that can be reached, forbidden edges left out.
 * @throw LogicError when unknown
 */
std::map<NodeId, int> stepDistances(const TopologicalMap &map, NodeId from);

} // namespace homeward
