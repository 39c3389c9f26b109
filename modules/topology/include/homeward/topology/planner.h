// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/topology/map.h>

#include <functional>
#include <map>
#include <set>

namespace homeward
{

/** What driving along an edge costs, either way: finite, 0.001 or more. */
using EdgeCost = std::function<double(const Edge &)>;

/** 1: the route with the fewest edges. */
double countEdge(const Edge &edge);

/**
 * The metres one must expect to drive along an edge until it is behind the robot: its length (2 m
 * where that is unknown, 0.1 m at least) times the tries it takes,
 *
 *     (tries + 1) / (successes + 1).
 */
double expectedMetres(const Edge &edge);

/**
 * The cheapest route, both ends included; of several, the one whose ids come first (compared place
 * by place). Dijkstra's algorithm. Forbidden edges are never used.
 * @param blocked more edges not to be used
 * @return nothing when no route exists; {from} when from equals to
 * @throw LogicError for unknown nodes, and for a cost that is none
 */
std::optional<std::vector<NodeId>> shortestPath(const TopologicalMap &map, NodeId from, NodeId to,
                                                const std::set<EdgeId> &blocked = {},
                                                const EdgeCost &cost = countEdge);

/**
 * The cheapest route to the nearest node that has an open direction, both ends included; {from}
 * when that is `from` itself. Of nodes equally near, the smallest id. The search goes no further
 * than that node's distance. Forbidden edges are never used.
 * @param blocked more edges not to be used
 * @return nothing when no open direction can be reached
 * @throw LogicError when the node is unknown, and for a cost that is none
 */
std::optional<std::vector<NodeId>> pathToNearestOpen(const TopologicalMap &map, NodeId from,
                                                     const std::set<EdgeId> &blocked = {},
                                                     const EdgeCost &cost = countEdge);

/**
 * Number of edges from `from` to every node that can be reached, forbidden edges left out.
 * @throw LogicError when unknown
 */
std::map<NodeId, int> stepDistances(const TopologicalMap &map, NodeId from);

} // namespace homeward
