// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/topology/planner.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>

#include <algorithm>
#include <functional>
#include <limits>

namespace homeward
{

namespace
{

// Vertex v of the graph is node v of the map: node ids count from 0.
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS,
                                    boost::no_property, boost::property<boost::edge_weight_t, int>>;
using Vertex = boost::graph_traits<Graph>::vertex_descriptor;

constexpr int kUnreached = std::numeric_limits<int>::max();

Vertex vertexOf(NodeId id)
{
  return static_cast<Vertex>(id.value);
}

NodeId nodeOf(Vertex vertex)
{
  return {static_cast<std::int64_t>(vertex)};
}

Graph graphOf(const TopologicalMap &map, const std::set<EdgeId> &blocked)
{
  Graph graph(map.nodes().size());
  for (const auto &[id, edge] : map.edges()) {
    if (blocked.count(id) == 0) {
      boost::add_edge(vertexOf(edge.a), vertexOf(edge.b), 1, graph);
    }
  }
  return graph;
}

/** Thrown by a visitor, as Boost.Graph asks for, to end a search early. */
struct SearchEnded
{};

/** Told of every vertex and its distance, nearest first; returns whether the search is over. */
using Stop = std::function<bool(Vertex, int)>;

class StoppingVisitor : public boost::default_dijkstra_visitor
{
public:
  StoppingVisitor(const Stop &stop, const std::vector<int> &distances)
      : m_stop(&stop), m_distances(&distances)
  {}

  void examine_vertex(Vertex vertex, const Graph &) // NOLINT(readability-identifier-naming)
  {
    if ((*m_stop)(vertex, (*m_distances)[vertex])) {
      throw SearchEnded{};
    }
  }

private:
  const Stop *m_stop;
  const std::vector<int> *m_distances;
};

/** Distances from `source`, exact for every vertex nearer than where `stop` ended the search. */
std::vector<int> search(const TopologicalMap &map, const std::set<EdgeId> &blocked, NodeId source,
                        const Stop &stop)
{
  const Graph graph = graphOf(map, blocked);
  std::vector<int> distances(boost::num_vertices(graph), kUnreached);
  const auto distanceMap =
      boost::make_iterator_property_map(distances.begin(), get(boost::vertex_index, graph));
  try {
    boost::dijkstra_shortest_paths(
        graph, vertexOf(source),
        boost::distance_map(distanceMap).visitor(StoppingVisitor(stop, distances)));
  }
  catch (const SearchEnded &) {
    return distances;
  }
  return distances;
}

} // namespace

std::optional<std::vector<NodeId>> shortestPath(const TopologicalMap &map, NodeId from, NodeId to,
                                                const std::set<EdgeId> &blocked)
{
  map.node(from);
  map.node(to);
  // Distances to the goal, so that the walk below can take the smallest id at every step.
  const std::vector<int> toGoal =
      search(map, blocked, to, [&](Vertex vertex, int) { return vertex == vertexOf(from); });
  if (toGoal[vertexOf(from)] == kUnreached) {
    return std::nullopt;
  }
  std::vector<NodeId> path{from};
  while (path.back() != to) {
    const int left = toGoal[vertexOf(path.back())];
    const std::vector<NodeId> &near = map.neighbours(path.back());
    path.push_back(*std::find_if(near.begin(), near.end(), [&](NodeId next) {
      return toGoal[vertexOf(next)] == left - 1 &&
             blocked.count(map.edgeBetween(path.back(), next)->id) == 0;
    }));
  }
  return path;
}

std::optional<std::vector<NodeId>> pathToNearestOpen(const TopologicalMap &map, NodeId from,
                                                     const std::set<EdgeId> &blocked)
{
  map.node(from);
  std::optional<NodeId> nearest;
  int nearestDistance = 0;
  search(map, blocked, from, [&](Vertex vertex, int distance) {
    // The heap hands out equally near vertices in no useful order: look at all of them.
    if (nearest && distance > nearestDistance) {
      return true;
    }
    const NodeId id = nodeOf(vertex);
    if (map.hasOpenDirection(id) && (!nearest || id < *nearest)) {
      nearest = id;
      nearestDistance = distance;
    }
    return false;
  });
  return nearest ? shortestPath(map, from, *nearest, blocked) : std::nullopt;
}

std::map<NodeId, int> stepDistances(const TopologicalMap &map, NodeId from)
{
  map.node(from);
  const std::vector<int> distances = search(map, {}, from, [](Vertex, int) { return false; });
  std::map<NodeId, int> steps;
  for (Vertex vertex = 0; vertex < distances.size(); ++vertex) {
    if (distances[vertex] != kUnreached) {
      steps.emplace(nodeOf(vertex), distances[vertex]);
    }
  }
  return steps;
}

} // namespace homeward
