// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/topology/planner.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <queue>

namespace homeward
{

namespace
{

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/** A value for every node, kept in pages that are made when first asked for: a search that ends
 * nearby costs no more in a large map than in a small one. */
template <class Value> class PerNode
{
public:
  PerNode(const TopologicalMap &map, Value unset)
      : m_unset(unset), m_pages(static_cast<std::size_t>(map.nextNodeId().value) / kPage + 1)
  {}

  Value &operator[](NodeId id)
  {
    const auto index = static_cast<std::size_t>(id.value);
    std::unique_ptr<Page> &page = m_pages[index / kPage];
    if (!page) {
      page = std::make_unique<Page>();
      page->fill(m_unset);
    }
    return (*page)[index % kPage];
  }

private:
  static constexpr std::size_t kPage = 256;
  using Page = std::array<Value, kPage>;

  Value m_unset;
  std::vector<std::unique_ptr<Page>> m_pages;
};

/** The map without the edges that must not be used. */
class Roads
{
public:
  Roads(const TopologicalMap &map, const std::set<EdgeId> &blocked)
      : m_map(&map), m_blocked(&blocked)
  {}

  const TopologicalMap &map() const { return *m_map; }

  const std::vector<Link> &from(NodeId node) const { return m_map->links(node); }

  /** Infinite when it must not be used. */
  double metres(const Link &link) const
  {
    return m_blocked->count(link.edge) == 0 ? link.metres : kUnreached;
  }

private:
  const TopologicalMap *m_map;
  const std::set<EdgeId> *m_blocked;
};

/** Breadth first, one step farther at a time. @throw LogicError when the source is unknown */
class StepSearch
{
public:
  StepSearch(const Roads &roads, NodeId source)
      : m_roads(roads), m_before(roads.map(), NodeId{}), m_front{source}
  {
    m_roads.map().node(source);
    m_before[source] = source;
  }

  /** The nodes as many steps away as next() was called, in the order of the routes to them: routes
   * of equal length that stand in order go on in order, as the links of a node do. So the first to
   * reach a node has the first of its routes. */
  const std::vector<NodeId> &front() const { return m_front; }

  void next()
  {
    std::vector<NodeId> farther;
    for (const NodeId node : m_front) {
      for (const Link &link : m_roads.from(node)) {
        NodeId &before = m_before[link.to];
        if (before == NodeId{} && m_roads.metres(link) < kUnreached) {
          before = node;
          farther.push_back(link.to);
        }
      }
    }
    m_front.swap(farther);
  }

  /** The nearest node that is a goal; of equally near ones the smallest. */
  template <class IsGoal> std::optional<NodeId> find(const IsGoal &isGoal)
  {
    std::optional<NodeId> best;
    for (; !m_front.empty(); next()) {
      for (const NodeId node : m_front) {
        if ((!best || node < *best) && isGoal(node)) {
          best = node;
        }
      }
      if (best) {
        break;
      }
    }
    return best;
  }

  /** To a node that was in front(). */
  std::vector<NodeId> pathTo(NodeId node)
  {
    std::vector<NodeId> path{node};
    while (m_before[path.back()] != path.back()) {
      path.push_back(m_before[path.back()]);
    }
    return {path.rbegin(), path.rend()};
  }

private:
  Roads m_roads;
  PerNode<NodeId> m_before; ///< itself for the source
  std::vector<NodeId> m_front;
};

/** Dijkstra's algorithm. @throw LogicError when the source is unknown */
class MetreSearch
{
public:
  MetreSearch(const Roads &roads, NodeId source)
      : m_roads(roads), m_source(source), m_distances(roads.map(), kUnreached)
  {
    m_roads.map().node(source);
    reach(source, 0.0);
  }

  /** As StepSearch::find(), by distance. */
  template <class IsGoal> std::optional<NodeId> find(const IsGoal &isGoal)
  {
    while (!m_queue.empty()) {
      const auto [distance, node] = m_queue.top();
      m_queue.pop();
      if (distance == m_distances[node]) { // else a shorter way to it was found meanwhile
        if (isGoal(node)) {
          return node;
        }
        spread(node, distance);
      }
    }
    return std::nullopt;
  }

  /** To the node that find() gave: from the source on, always to the smallest id that leads there.
   */
  std::vector<NodeId> pathTo(NodeId goal)
  {
    PerNode<bool> leads = leadingTo(goal);
    std::vector<NodeId> path{m_source};
    while (path.back() != goal) {
      const std::vector<Link> &links = m_roads.from(path.back());
      path.push_back(std::find_if(links.begin(), links.end(), [&](const Link &link) {
                       return leads[link.to] && m_distances[path.back()] + m_roads.metres(link) ==
                                                    m_distances[link.to];
                     })->to);
    }
    return path;
  }

private:
  using Entry = std::pair<double, NodeId>;

  struct Farther
  {
    bool operator()(const Entry &a, const Entry &b) const
    {
      return a.first != b.first ? a.first > b.first : b.second < a.second;
    }
  };

  void reach(NodeId node, double distance)
  {
    double &known = m_distances[node];
    if (distance < known) {
      known = distance;
      m_queue.emplace(distance, node);
    }
  }

  void spread(NodeId node, double distance)
  {
    for (const Link &link : m_roads.from(node)) {
      reach(link.to, distance + m_roads.metres(link));
    }
  }

  /** The nodes on shortest routes to `goal`. */
  PerNode<bool> leadingTo(NodeId goal)
  {
    PerNode<bool> leads(m_roads.map(), false);
    std::vector<NodeId> todo{goal};
    leads[goal] = true;
    while (!todo.empty()) {
      const NodeId node = todo.back();
      todo.pop_back();
      for (const Link &link : m_roads.from(node)) {
        if (!leads[link.to] && m_distances[link.to] + m_roads.metres(link) == m_distances[node]) {
          leads[link.to] = true;
          todo.push_back(link.to);
        }
      }
    }
    return leads;
  }

  Roads m_roads;
  NodeId m_source;
  PerNode<double> m_distances;
  std::priority_queue<Entry, std::vector<Entry>, Farther> m_queue;
};

/** The route to the nearest node that is a goal; of equally near ones to the smallest. */
template <class Search, class IsGoal>
std::optional<std::vector<NodeId>> route(Search search, const IsGoal &isGoal)
{
  const std::optional<NodeId> goal = search.find(isGoal);
  return goal ? std::optional(search.pathTo(*goal)) : std::nullopt;
}

template <class IsGoal>
std::optional<std::vector<NodeId>> route(const Roads &roads, NodeId from, RouteCost cost,
                                         const IsGoal &isGoal)
{
  return cost == RouteCost::Edges ? route(StepSearch(roads, from), isGoal)
                                  : route(MetreSearch(roads, from), isGoal);
}

} // namespace

std::optional<std::vector<NodeId>> shortestPath(const TopologicalMap &map, NodeId from, NodeId to,
                                                const std::set<EdgeId> &blocked, RouteCost cost)
{
  map.node(to);
  return route(Roads(map, blocked), from, cost, [to](NodeId node) { return node == to; });
}

std::optional<std::vector<NodeId>> pathToNearestOpen(const TopologicalMap &map, NodeId from,
                                                     const std::set<EdgeId> &blocked,
                                                     RouteCost cost)
{
  return route(Roads(map, blocked), from, cost,
               [&map](NodeId node) { return map.hasOpenDirection(node); });
}

std::map<NodeId, int> stepDistances(const TopologicalMap &map, NodeId from)
{
  const std::set<EdgeId> none;
  std::map<NodeId, int> steps;
  int count = 0;
  for (StepSearch search({map, none}, from); !search.front().empty(); search.next()) {
    for (const NodeId node : search.front()) {
      steps.emplace(node, count);
    }
    ++count;
  }
  return steps;
}

} // namespace homeward
