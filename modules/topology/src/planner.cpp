// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/topology/planner.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace homeward
{

namespace
{

constexpr double kLeastCost = 0.001;    // a sum of millions still tells it
constexpr double kUnknownLength = 2.0;  // metres
constexpr double kShortestLength = 0.1; // metres
constexpr double kUnreached = std::numeric_limits<double>::infinity();

/** Dijkstra's algorithm from one node on, as far as it is asked to go. */
class Search
{
public:
  Search(const TopologicalMap &map, const std::set<EdgeId> &blocked, const EdgeCost &cost,
         NodeId source)
      : m_map(&map), m_blocked(&blocked), m_cost(&cost),
        m_distances(static_cast<std::size_t>(map.nextNodeId().value), kUnreached)
  {
    map.node(source);
    reach(source, 0.0);
  }

  /** The next node by distance, equally near ones in order of ids; nothing when all are through. */
  std::optional<NodeId> next()
  {
    while (!m_queue.empty()) {
      const auto [distance, id] = m_queue.top();
      m_queue.pop();
      if (distance == this->distance(id)) { // else a shorter way to it was found meanwhile
        spread(id, distance);
        return id;
      }
    }
    return std::nullopt;
  }

  /** Exact for every node that next() has given. */
  double distance(NodeId id) const { return m_distances[static_cast<std::size_t>(id.value)]; }

  /** The cost of an edge; infinite when it may not be used. @throw LogicError */
  double cost(EdgeId id) const
  {
    const Edge &edge = m_map->edge(id);
    if (edge.forbidden || m_blocked->count(id) != 0) {
      return kUnreached;
    }
    const double cost = (*m_cost)(edge);
    if (!(std::isfinite(cost) && cost >= kLeastCost)) {
      throw LogicError("planner: edge " + std::to_string(id.value) + " cannot cost " +
                       std::to_string(cost));
    }
    return cost;
  }

private:
  using Entry = std::pair<double, NodeId>;

  void reach(NodeId id, double distance)
  {
    double &known = m_distances[static_cast<std::size_t>(id.value)];
    if (distance < known) {
      known = distance;
      m_queue.emplace(distance, id);
    }
  }

  void spread(NodeId id, double distance)
  {
    const std::vector<NodeId> &near = m_map->neighbours(id);
    const std::vector<EdgeId> &edges = m_map->edgesAt(id);
    for (std::size_t i = 0; i < near.size(); ++i) {
      reach(near[i], distance + cost(edges[i]));
    }
  }

  struct Farther
  {
    bool operator()(const Entry &a, const Entry &b) const
    {
      return a.first != b.first ? a.first > b.first : b.second < a.second;
    }
  };

  const TopologicalMap *m_map;
  const std::set<EdgeId> *m_blocked;
  const EdgeCost *m_cost;
  std::vector<double> m_distances; ///< by node
  std::priority_queue<Entry, std::vector<Entry>, Farther> m_queue;
};

/** The smallest neighbour that is as near to the source of `search` as the way from `from` is long.
 */
NodeId step(const TopologicalMap &map, const Search &search, NodeId from)
{
  const std::vector<NodeId> &near = map.neighbours(from);
  const std::vector<EdgeId> &edges = map.edgesAt(from);
  std::size_t i = 0;
  while (!(search.distance(near[i]) < search.distance(from) &&
           search.distance(near[i]) + search.cost(edges[i]) == search.distance(from))) {
    ++i;
  }
  return near[i];
}

} // namespace

double countEdge(const Edge &)
{
  return 1.0;
}

double expectedMetres(const Edge &edge)
{
  const EdgeStatistics &known = edge.statistics;
  return std::max(edge.length.value_or(kUnknownLength), kShortestLength) * (known.tries + 1) /
         (known.successes + 1);
}

std::optional<std::vector<NodeId>> shortestPath(const TopologicalMap &map, NodeId from, NodeId to,
                                                const std::set<EdgeId> &blocked,
                                                const EdgeCost &cost)
{
  map.node(from);
  // From the goal, so that the walk below can take the smallest id at every step.
  Search search(map, blocked, cost, to);
  std::optional<NodeId> reached = search.next();
  while (reached && *reached != from) {
    reached = search.next();
  }
  if (!reached) {
    return std::nullopt;
  }
  std::vector<NodeId> path{from};
  while (path.back() != to) {
    path.push_back(step(map, search, path.back()));
  }
  return path;
}

std::optional<std::vector<NodeId>> pathToNearestOpen(const TopologicalMap &map, NodeId from,
                                                     const std::set<EdgeId> &blocked,
                                                     const EdgeCost &cost)
{
  if (map.hasOpenDirection(from)) {
    return std::vector<NodeId>{from};
  }
  Search search(map, blocked, cost, from);
  while (const std::optional<NodeId> node = search.next()) {
    if (map.hasOpenDirection(*node)) {
      return shortestPath(map, from, *node, blocked, cost);
    }
  }
  return std::nullopt;
}

std::map<NodeId, int> stepDistances(const TopologicalMap &map, NodeId from)
{
  const std::set<EdgeId> none;
  const EdgeCost cost = countEdge;
  Search search(map, none, cost, from);
  std::map<NodeId, int> steps;
  while (const std::optional<NodeId> node = search.next()) {
    steps.emplace(*node, static_cast<int>(search.distance(*node)));
  }
  return steps;
}

} // namespace homeward
