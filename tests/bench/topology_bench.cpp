// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/random.h>
#include <homeward/topology/planner.h>

#include <benchmark/benchmark.h>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

// The way to the nearest place with an open direction, from a corner of a square grid where every
// third cross-edge is missing, and the others are 0.8 to 1.2 m long. Arguments: number of nodes;
// where the only open direction is, in per cent of the nodes by distance (0: ten edges away);
// RouteCost: 0 counts edges, 1 adds metres. Boost.Graph's own search runs beside it over the same
// graph with the same costs, built before: over everything, and with a visitor that ends it at the
// first hit.

namespace homeward
{
namespace
{

using Graph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                          boost::property<boost::edge_weight_t, double>>;
using Vertex = boost::graph_traits<Graph>::vertex_descriptor;

/** A building with one direction left, as a map and as Boost has graphs. */
struct Building
{
  TopologicalMap map;
  Graph graph;
  NodeId open;
  RouteCost cost;
};

NodeId openNode(std::int64_t side, std::int64_t percent)
{
  if (percent == 0) {
    return NodeId{5 * side + 5};
  }
  // Nodes within column + row < d of the corner are d * d / 2 of side * side.
  const double share = static_cast<double>(percent) / 100.0;
  const auto along =
      static_cast<std::int64_t>(share > 0.99 ? static_cast<double>(side - 1)
                                             : std::sqrt(share / 2.0) * static_cast<double>(side));
  return NodeId{along * side + along};
}

bool hasEdge(std::int64_t column, std::int64_t row)
{
  return row == 0 || (column + 2 * row) % 3 != 0;
}

std::unique_ptr<Building> build(std::int64_t nodes, std::int64_t percent, RouteCost cost)
{
  const auto side = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(nodes))));
  auto building = std::make_unique<Building>();
  building->open = openNode(side, percent);
  building->cost = cost;
  for (std::int64_t id = 0; id < side * side; ++id) {
    Node node{NodeId{id}, {{DirectionId{0}, 0.5, 1.0, DirectionState::Closed, "blocked"}}};
    if (node.id == building->open) {
      node.directions[0] = {DirectionId{0}, 0.5, 1.0, DirectionState::Open, ""};
    }
    building->map.apply(NodeAdded{node});
  }
  building->graph = Graph(static_cast<std::size_t>(side * side));
  Random random(1, 0);
  const auto join = [&](std::int64_t a, std::int64_t b) {
    const double length = random.uniform(0.8, 1.2);
    building->map.apply(
        EdgeAdded{{building->map.nextEdgeId(), NodeId{a}, NodeId{b}, 0.0, 0.0, length}});
    boost::add_edge(static_cast<Vertex>(a), static_cast<Vertex>(b),
                    cost == RouteCost::Edges ? 1.0 : length, building->graph);
  };
  for (std::int64_t row = 0; row < side; ++row) {
    for (std::int64_t column = 0; column < side; ++column) {
      const std::int64_t id = row * side + column;
      if (column + 1 < side && hasEdge(column, row)) {
        join(id, id + 1);
      }
      if (row + 1 < side) {
        join(id, id + side);
      }
    }
  }
  return building;
}

/** Built once for all that run on it, one at a time: a million nodes take some memory. */
const Building &building(const benchmark::State &state)
{
  static std::unique_ptr<Building> last;
  static std::array<std::int64_t, 3> lastKey{};
  const std::array<std::int64_t, 3> key{state.range(0), state.range(1), state.range(2)};
  if (key != lastKey) {
    last.reset();
    last = build(key[0], key[1], static_cast<RouteCost>(key[2]));
    lastKey = key;
  }
  return *last;
}

std::vector<NodeId> pathBack(const std::vector<Vertex> &before, NodeId to)
{
  std::vector<NodeId> path{to};
  for (auto vertex = static_cast<Vertex>(to.value); before[vertex] != vertex;) {
    vertex = before[vertex];
    path.push_back(NodeId{static_cast<std::int64_t>(vertex)});
  }
  return {path.rbegin(), path.rend()};
}

struct Found
{};

/** Ends a search at a vertex, by throwing as Boost.Graph asks for. */
class StopAt : public boost::default_dijkstra_visitor
{
public:
  explicit StopAt(Vertex vertex) : m_vertex(vertex) {}

  void examine_vertex(Vertex vertex, const Graph &) const // NOLINT(readability-identifier-naming)
  {
    if (vertex == m_vertex) {
      throw Found{};
    }
  }

private:
  Vertex m_vertex;
};

template <class Visitor> std::vector<NodeId> boostPath(const Building &building, Visitor visitor)
{
  std::vector<Vertex> before(boost::num_vertices(building.graph));
  std::vector<double> distances(before.size());
  try {
    boost::dijkstra_shortest_paths(
        building.graph, Vertex{0},
        boost::predecessor_map(before.data()).distance_map(distances.data()).visitor(visitor));
  }
  catch (const Found &) {
    return pathBack(before, building.open);
  }
  return pathBack(before, building.open);
}

void report(benchmark::State &state, std::size_t length)
{
  state.counters["edges"] = static_cast<double>(length - 1);
}

void BM_PathToNearestOpen(benchmark::State &state)
{
  const Building &made = building(state);
  std::size_t length = 0;
  for (auto _ : state) {
    length = pathToNearestOpen(made.map, NodeId{0}, {}, made.cost)->size();
  }
  report(state, length);
}

void BM_BoostDijkstraOverEverything(benchmark::State &state)
{
  const Building &made = building(state);
  std::size_t length = 0;
  for (auto _ : state) {
    length = boostPath(made, boost::default_dijkstra_visitor()).size();
  }
  report(state, length);
}

void BM_BoostDijkstraToTheFirst(benchmark::State &state)
{
  const Building &made = building(state);
  std::size_t length = 0;
  for (auto _ : state) {
    length = boostPath(made, StopAt(static_cast<Vertex>(made.open.value))).size();
  }
  report(state, length);
}

const int kRegistered = [] {
  constexpr std::pair<const char *, void (*)(benchmark::State &)> kRuns[] = {
      {"nearest open", &BM_PathToNearestOpen},
      {"Boost, everything", &BM_BoostDijkstraOverEverything},
      {"Boost, to the first", &BM_BoostDijkstraToTheFirst}};
  for (const RouteCost cost : {RouteCost::Edges, RouteCost::ExpectedMetres}) {
    for (const std::int64_t nodes : {1000, 100000, 1000000}) {
      for (const std::int64_t percent : {0, 50, 100}) {
        for (const auto &[name, run] : kRuns) {
          benchmark::RegisterBenchmark(name, run)
              ->Args({nodes, percent, static_cast<std::int64_t>(cost)})
              ->Unit(benchmark::kMicrosecond);
        }
      }
    }
  }
  return 0;
}();

} // namespace
} // namespace homeward
