// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 10: a map of places and ways, without coordinates, is enough to plan on.
#include <homeward/core/angle.h>
#include <homeward/topology/planner.h>
#include <homeward/viewer/map_picture.h>

#include <opencv2/imgcodecs.hpp>

#include <cstdio>
#include <utility>

using namespace homeward;

/**
 *     0 --- 1 --- 2 --- 3
 *     |           |     |
 *     4 --- 5 --- 6     7 --->  nobody has driven there yet
 */
TopologicalMap makeMap()
{
  TopologicalMap map;
  for (int i = 0; i < 7; ++i) {
    map.apply(NodeAdded{{map.nextNodeId()}});
  }
  const Direction east{DirectionId{0}, radians(0.0), radians(40.0)};
  map.apply(NodeAdded{{map.nextNodeId(), {east}}});
  const std::vector<std::pair<int, int>> ways = {{0, 1}, {1, 2}, {2, 3}, {0, 4},
                                                 {4, 5}, {5, 6}, {6, 2}, {3, 7}};
  for (const auto &[a, b] : ways) {
    map.apply(EdgeAdded{{map.nextEdgeId(), NodeId{a}, NodeId{b}}});
  }
  return map;
}

void print(const char *question, const std::optional<std::vector<NodeId>> &route)
{
  std::printf("%s:", question);
  if (!route) {
    std::printf(" there is no way");
  }
  for (const NodeId node : route.value_or(std::vector<NodeId>())) {
    std::printf(" %d", static_cast<int>(node.value));
  }
  std::printf("\n");
}

int main()
{
  TopologicalMap map = makeMap();
  const NodeId start{0};
  const NodeId goal{6};

  const auto route = shortestPath(map, start, goal);
  print("from 0 to 6", route);

  // A way that failed is left out of the next plan; the map keeps it.
  const std::set<EdgeId> failed = {map.edgeBetween(NodeId{1}, NodeId{2})->id};
  print("the same when 1 - 2 has failed", shortestPath(map, start, goal, failed));

  print("to the next open direction", pathToNearestOpen(map, start));

  const std::map<NodeId, int> steps = stepDistances(map, start);
  std::printf("steps from 0 to 7: %d\n", steps.at(NodeId{7}));

  MapPicture picture;
  picture.title = "From 0 to 6";
  picture.width = 700;
  picture.route = *route;
  cv::imwrite("10-plan.png", mapImage(map, picture));

  // A map grows by changes that keep its rules; what breaks one leaves it as it was.
  map.apply(DirectionSettled{NodeId{7}, DirectionId{0}, DirectionState::Closed, "blocked"});
  print("with 7 closed, to the next open direction", pathToNearestOpen(map, start));
}
