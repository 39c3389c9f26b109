// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/mission_truth.h>

#include <homeward/evaluation/coverage.h>

#include <algorithm>
#include <iterator>

namespace homeward
{

namespace
{

constexpr double kDuplicateDistance = 0.5; // metres

using Places = std::map<NodeId, Pose2>;

double coverageOf(const FreeSpace &space, const Eigen::Vector2d &start, const Places &nodes,
                  double reach)
{
  CoverageMeter meter(space, start, reach);
  for (const auto &[id, pose] : nodes) {
    meter.add(pose.translation());
  }
  return meter.share();
}

bool falseEdge(const FreeSpace &space, const Places &nodes, const std::pair<NodeId, NodeId> &edge,
               double limit)
{
  const auto a = nodes.find(edge.first);
  const auto b = nodes.find(edge.second);
  return a == nodes.end() || b == nodes.end() ||
         !space.pathLength(a->second.translation(), b->second.translation(), limit);
}

int duplicatePairs(const FreeSpace &space, const Places &nodes)
{
  int pairs = 0;
  for (auto a = nodes.begin(); a != nodes.end(); ++a) {
    pairs += static_cast<int>(std::count_if(std::next(a), nodes.end(), [&](const auto &b) {
      const Eigen::Vector2d placeA = a->second.translation();
      const Eigen::Vector2d placeB = b.second.translation();
      return (placeA - placeB).norm() < kDuplicateDistance && space.sees(placeA, placeB);
    }));
  }
  return pairs;
}

} // namespace

MissionTruth judgeMission(const FreeSpace &space, const Eigen::Vector2d &start, const Places &nodes,
                          const std::vector<std::pair<NodeId, NodeId>> &edges,
                          double forwardDistance)
{
  MissionTruth truth;
  truth.coverage = coverageOf(space, start, nodes, coverageReach(forwardDistance));
  truth.falseEdges =
      static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](const auto &edge) {
        return falseEdge(space, nodes, edge, 2.0 * forwardDistance + 1.0);
      }));
  truth.duplicateNodes = duplicatePairs(space, nodes);
  return truth;
}

MissionTruth judgeMission(const FreeSpace &space, const Eigen::Vector2d &start, const Places &nodes,
                          const TopologicalMap &map, double forwardDistance)
{
  Places known;
  std::copy_if(nodes.begin(), nodes.end(), std::inserter(known, known.end()),
               [&](const Places::value_type &node) { return map.contains(node.first); });
  std::vector<std::pair<NodeId, NodeId>> edges;
  for (const auto &[id, edge] : map.edges()) {
    edges.emplace_back(edge.a, edge.b);
  }
  return judgeMission(space, start, known, edges, forwardDistance);
}

} // namespace homeward
