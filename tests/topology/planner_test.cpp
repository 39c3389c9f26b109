// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/topology/planner.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

using ::testing::ElementsAre;
using ::testing::Optional;
using ::testing::Pair;

using Path = std::vector<NodeId>;

/** Nodes 0 to n - 1; those in `open` have one open direction. */
TopologicalMap mapOf(int n, const std::vector<std::pair<int, int>> &edges,
                     const std::vector<int> &open = {})
{
  TopologicalMap map;
  for (int i = 0; i < n; ++i) {
    Node node{{i}, {}};
    if (std::find(open.begin(), open.end(), i) != open.end()) {
      node.directions.push_back({{0}, 0.0, 0.3});
    }
    map.apply(NodeAdded{node});
  }
  for (const auto &[a, b] : edges) {
    map.apply(EdgeAdded{{map.nextEdgeId(), {a}, {b}}});
  }
  return map;
}

// Two rooms on a corridor, and a shed that nobody can reach:
//
//     1 --- 2 --- 3          8 --- 9
//     |           |
//     0 --- 4 --- 5 --- 6 --- 7
TopologicalMap flat(const std::vector<int> &open = {})
{
  return mapOf(10, {{0, 1}, {1, 2}, {2, 3}, {3, 5}, {0, 4}, {4, 5}, {5, 6}, {6, 7}, {8, 9}}, open);
}

TEST(ShortestPath, TakesTheShortSideOfTheLoop)
{
  EXPECT_THAT(shortestPath(flat(), {0}, {7}),
              Optional(ElementsAre(NodeId{0}, NodeId{4}, NodeId{5}, NodeId{6}, NodeId{7})));
}

TEST(ShortestPath, GoesRoundABlockedEdge)
{
  const TopologicalMap map = flat({7});
  const EdgeId blocked = map.edgeBetween({4}, {5})->id;
  EXPECT_THAT(
      shortestPath(map, {4}, {5}, {blocked}),
      Optional(ElementsAre(NodeId{4}, NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}, NodeId{5})));
  EXPECT_EQ(pathToNearestOpen(map, {4}, {blocked})->size(), 8U);
  EXPECT_EQ(shortestPath(map, {8}, {9}, {map.edgeBetween({8}, {9})->id}), std::nullopt);
}

TEST(ShortestPath, OfANodeToItselfIsTheNode)
{
  EXPECT_THAT(shortestPath(flat(), {6}, {6}), Optional(ElementsAre(NodeId{6})));
}

TEST(ShortestPath, IsNothingWithoutARoute)
{
  EXPECT_EQ(shortestPath(flat(), {0}, {8}), std::nullopt);
}

TEST(ShortestPath, RefusesUnknownNodes)
{
  EXPECT_THROW(shortestPath(flat(), {0}, {10}), LogicError);
  EXPECT_THROW(shortestPath(flat(), {-1}, {0}), LogicError);
}

// Two ways round, equally long; edges entered so that neither way is found first by luck alone:
//
//        3
//      /   \.
//     0     4
//      \   /
//        1
TEST(ShortestPath, OfEquallyLongOnesHasTheSmallestIds)
{
  const Path expected{{0}, {1}, {4}};
  EXPECT_EQ(shortestPath(mapOf(5, {{0, 3}, {3, 4}, {0, 1}, {1, 4}}), {0}, {4}), expected);
  EXPECT_EQ(shortestPath(mapOf(5, {{1, 4}, {0, 1}, {3, 4}, {0, 3}}), {0}, {4}), expected);
}

TEST(PathToNearestOpen, GoesToTheNearest)
{
  EXPECT_THAT(pathToNearestOpen(flat({3, 6}), {0}),
              Optional(ElementsAre(NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3})));
  EXPECT_THAT(pathToNearestOpen(flat({3, 6}), {4}),
              Optional(ElementsAre(NodeId{4}, NodeId{5}, NodeId{3})));
}

TEST(PathToNearestOpen, StaysWhereADirectionIsOpen)
{
  EXPECT_THAT(pathToNearestOpen(flat({4, 5}), {5}), Optional(ElementsAre(NodeId{5})));
}

TEST(PathToNearestOpen, OfEquallyNearOnesTakesTheSmallestId)
{
  EXPECT_THAT(pathToNearestOpen(flat({2, 4}), {0}), Optional(ElementsAre(NodeId{0}, NodeId{4})));
  EXPECT_THAT(pathToNearestOpen(flat({6, 3, 4}), {5}), Optional(ElementsAre(NodeId{5}, NodeId{3})));
}

TEST(PathToNearestOpen, IsNothingWhenAllThatCanBeReachedIsSettled)
{
  EXPECT_EQ(pathToNearestOpen(flat(), {0}), std::nullopt);
  EXPECT_EQ(pathToNearestOpen(flat({9}), {0}), std::nullopt);
  EXPECT_THROW(pathToNearestOpen(flat(), {12}), LogicError);
}

TEST(Planner, NeverUsesAForbiddenEdge)
{
  TopologicalMap map = flat({7});
  map.apply(EdgeForbidden{map.edgeBetween({4}, {5})->id});
  EXPECT_EQ(shortestPath(map, {4}, {5})->size(), 6U);
  EXPECT_EQ(pathToNearestOpen(map, {4})->size(), 8U);
  EXPECT_EQ(stepDistances(map, {4}).at({5}), 5);
  map.apply(EdgeForbidden{map.edgeBetween({6}, {7})->id});
  EXPECT_EQ(pathToNearestOpen(map, {4}), std::nullopt);
  EXPECT_EQ(shortestPath(map, {0}, {7}, {}, RouteCost::ExpectedMetres), std::nullopt);
}

TEST(Planner, TakesMoreEdgesWhereTheyCostLess)
{
  TopologicalMap map = flat({6});
  const EdgeId corridor = map.edgeBetween({4}, {5})->id;
  const Path straight{{0}, {4}, {5}, {6}};
  const Path round{{0}, {1}, {2}, {3}, {5}, {6}};
  EXPECT_EQ(shortestPath(map, {0}, {6}, {}, RouteCost::ExpectedMetres), straight);
  map.apply(EdgeTried{corridor, "blocked", 9.0, 1.0});
  EXPECT_EQ(pathToNearestOpen(map, {0}, {}, RouteCost::ExpectedMetres), straight); // 8 m, not 10
  map.apply(EdgeTried{corridor, "blocked", 9.0, 2.0});
  EXPECT_EQ(shortestPath(map, {0}, {6}, {}, RouteCost::ExpectedMetres),
            round); // 10 m both, smaller ids
  EXPECT_EQ(pathToNearestOpen(map, {0}, {}, RouteCost::ExpectedMetres), round);
  EXPECT_EQ(shortestPath(map, {0}, {6}), straight);
}

TEST(Planner, GoesFar)
{
  constexpr int kNodes = 1000;
  std::vector<std::pair<int, int>> edges;
  for (int i = 1; i < kNodes; ++i) {
    edges.emplace_back(i - 1, i);
  }
  const TopologicalMap corridor = mapOf(kNodes, edges, {kNodes - 1});
  EXPECT_EQ(pathToNearestOpen(corridor, {0})->size(), 1000U);
  EXPECT_EQ(pathToNearestOpen(corridor, {0}, {}, RouteCost::ExpectedMetres)->size(), 1000U);
}

TEST(ExpectedMetres, AreLengthTimesExpectedTries)
{
  EXPECT_EQ(expectedMetres({{0}, {0}, {1}}), 2.0);
  EXPECT_EQ(expectedMetres({{0}, {0}, {1}, {}, {}, 3.0, {5, 5}}), 3.0);
  EXPECT_EQ(expectedMetres({{0}, {0}, {1}, {}, {}, 3.0, {5, 1}}), 9.0);
  EXPECT_EQ(expectedMetres({{0}, {0}, {1}, {}, {}, 0.0}), 0.1);
  EXPECT_EQ(expectedMetres({{0}, {0}, {1}, {}, {}, 1e300, {9, 0}}), 1e6);
}

TEST(StepDistances, CountEdgesAndLeaveOutWhatCannotBeReached)
{
  EXPECT_THAT(stepDistances(flat(), {6}),
              ElementsAre(Pair(NodeId{0}, 3), Pair(NodeId{1}, 4), Pair(NodeId{2}, 3),
                          Pair(NodeId{3}, 2), Pair(NodeId{4}, 2), Pair(NodeId{5}, 1),
                          Pair(NodeId{6}, 0), Pair(NodeId{7}, 1)));
  EXPECT_THROW(stepDistances(flat(), {12}), LogicError);
}

/** Every path without repeated nodes that continues `path` to `to`, appended to `all`. */
void enumerate(const TopologicalMap &map, const Path &path, NodeId to, std::vector<Path> &all)
{
  if (path.back() == to) {
    all.push_back(path);
    return;
  }
  for (const NodeId next : map.neighbours(path.back())) {
    if (std::find(path.begin(), path.end(), next) == path.end()) {
      Path longer = path;
      longer.push_back(next);
      enumerate(map, longer, to, all);
    }
  }
}

/** Of all simple paths the shortest; of those the first in order of ids. */
std::optional<Path> bestOf(const TopologicalMap &map, NodeId from, NodeId to)
{
  std::vector<Path> all;
  enumerate(map, {from}, to, all);
  const auto best = std::min_element(all.begin(), all.end(), [](const Path &a, const Path &b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return best == all.end() ? std::nullopt : std::optional<Path>(*best);
}

TopologicalMap randomMap(Random &random)
{
  const int n = static_cast<int>(random.uniform(1.0, 8.0));
  const double density = random.uniform(0.1, 0.7);
  std::vector<std::pair<int, int>> edges;
  std::vector<int> open;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      if (random.uniform(0.0, 1.0) < density) {
        edges.emplace_back(random.uniform(0.0, 1.0) < 0.5 ? std::pair{a, b} : std::pair{b, a});
      }
    }
    if (random.uniform(0.0, 1.0) < 0.3) {
      open.push_back(a);
    }
  }
  std::reverse(edges.begin(), edges.end());
  return mapOf(n, edges, open);
}

TEST(PlannerLaws, TheRouteIsTheBestOfAllThatCanBeEnumerated)
{
  Random random(1, 0);
  int routes = 0;
  for (int round = 0; round < 60; ++round) {
    const TopologicalMap map = randomMap(random);
    for (const auto &[from, unused] : map.nodes()) {
      const std::map<NodeId, int> steps = stepDistances(map, from);
      for (const auto &[to, alsoUnused] : map.nodes()) {
        const std::optional<Path> route = shortestPath(map, from, to);
        ASSERT_EQ(route, bestOf(map, from, to)) << from.value << " to " << to.value;
        ASSERT_EQ(route.has_value(), steps.count(to) == 1);
        if (route) {
          ++routes;
          ASSERT_EQ(steps.at(to) + 1, static_cast<int>(route->size()));
        }
      }
    }
  }
  EXPECT_GT(routes, 500);
}

TEST(PlannerLaws, NoOpenNodeIsNearerThanTheOneChosen)
{
  Random random(2, 0);
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    const TopologicalMap map = randomMap(random);
    std::optional<Path> best;
    for (const auto &[id, unused] : map.nodes()) {
      const std::optional<Path> route = shortestPath(map, {0}, id);
      if (map.hasOpenDirection(id) && route && (!best || route->size() < best->size())) {
        best = route;
      }
    }
    found += best ? 1 : 0;
    ASSERT_EQ(pathToNearestOpen(map, {0}), best);
  }
  EXPECT_GT(found, 50);
}

/** A map with gaps, forbidden edges and lengths, of which sums are often the same. */
TopologicalMap randomBuilding(Random &random)
{
  TopologicalMap map;
  const int n = static_cast<int>(random.uniform(2.0, 40.0));
  for (int i = 0; i < n; ++i) {
    const DirectionState state =
        random.uniform(0.0, 1.0) < 0.1 ? DirectionState::Open : DirectionState::Closed;
    map.apply(NodeAdded{{{i}, {{{0}, 0.0, 0.3, state}}}});
  }
  for (int tries = 0; tries < 3 * n; ++tries) {
    const NodeId a{static_cast<int>(random.uniform(0.0, n))};
    const NodeId b{static_cast<int>(random.uniform(0.0, n))};
    if (a != b && !map.edgeBetween(a, b)) {
      const EdgeId id = map.nextEdgeId();
      map.apply(EdgeAdded{{id, a, b, {}, {}, 0.5 * std::floor(random.uniform(1.0, 6.0))}});
      if (random.uniform(0.0, 1.0) < 0.2) {
        map.apply(EdgeTried{id, "blocked"});
      }
      map.apply(EdgeForbidden{id, random.uniform(0.0, 1.0) < 0.1});
    }
  }
  for (int i = 0; i < n / 5; ++i) {
    const NodeId gone{static_cast<int>(random.uniform(0.0, n))};
    if (map.contains(gone)) {
      map.apply(NodeRemoved{gone});
    }
  }
  return map;
}

using Costs = std::map<NodeId, double>; ///< of the best routes to a node, where there is one

double costOf(const Edge &edge, const std::set<EdgeId> &blocked, RouteCost cost)
{
  if (edge.forbidden || blocked.count(edge.id) == 1) {
    return std::numeric_limits<double>::infinity();
  }
  return cost == RouteCost::Edges ? 1.0 : expectedMetres(edge);
}

/** Lowered along every edge until nothing gets lower any more. */
Costs costsTo(const TopologicalMap &map, NodeId to, const std::set<EdgeId> &blocked, RouteCost cost)
{
  Costs costs;
  for (const auto &[id, unused] : map.nodes()) {
    costs[id] = id == to ? 0.0 : std::numeric_limits<double>::infinity();
  }
  for (std::size_t round = 0; round < map.nodes().size(); ++round) {
    for (const auto &[id, edge] : map.edges()) {
      const double along = costOf(edge, blocked, cost);
      costs[edge.a] = std::min(costs[edge.a], costs[edge.b] + along);
      costs[edge.b] = std::min(costs[edge.b], costs[edge.a] + along);
    }
  }
  return costs;
}

/** From node to node to the smallest that is on a best route. */
std::optional<Path> plainRoute(const TopologicalMap &map, NodeId from, NodeId to,
                               const std::set<EdgeId> &blocked, RouteCost cost)
{
  const Costs costs = costsTo(map, to, blocked, cost);
  if (std::isinf(costs.at(from))) {
    return std::nullopt;
  }
  Path path{from};
  while (path.back() != to) {
    for (const NodeId near : map.neighbours(path.back())) {
      const double along = costOf(*map.edgeBetween(path.back(), near), blocked, cost);
      if (costs.at(near) + along == costs.at(path.back())) {
        path.push_back(near);
        break;
      }
    }
  }
  return path;
}

std::optional<Path> plainRouteToOpen(const TopologicalMap &map, NodeId from,
                                     const std::set<EdgeId> &blocked, RouteCost cost)
{
  std::optional<NodeId> nearest;
  const Costs costs = costsTo(map, from, blocked, cost);
  for (const auto &[id, unused] : map.nodes()) {
    if (map.hasOpenDirection(id) && !std::isinf(costs.at(id)) &&
        (!nearest || costs.at(id) < costs.at(*nearest))) {
      nearest = id;
    }
  }
  return nearest ? plainRoute(map, from, *nearest, blocked, cost) : std::nullopt;
}

TEST(PlannerLaws, RoutesAreThoseOfAPlainSearch)
{
  Random random(3, 0);
  int found = 0;
  for (int round = 0; round < 300; ++round) {
    const TopologicalMap map = randomBuilding(random);
    const NodeId from = (*map.nodes().begin()).first;
    std::set<EdgeId> blocked;
    for (const auto &[id, unused] : map.edges()) {
      if (random.uniform(0.0, 1.0) < 0.1) {
        blocked.insert(id);
      }
    }
    for (const RouteCost cost : {RouteCost::Edges, RouteCost::ExpectedMetres}) {
      for (const auto &[to, unused] : map.nodes()) {
        ASSERT_EQ(shortestPath(map, from, to, blocked, cost),
                  plainRoute(map, from, to, blocked, cost));
      }
      const std::optional<Path> route = pathToNearestOpen(map, from, blocked, cost);
      ASSERT_EQ(route, plainRouteToOpen(map, from, blocked, cost));
      found += route ? 1 : 0;
    }
  }
  EXPECT_GT(found, 300);
}

} // namespace
} // namespace homeward
