// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>
#include <homeward/core/pose2.h>
#include <homeward/sim/free_space.h>
#include <homeward/topology/map.h>

#include <map>
#include <utility>
#include <vector>

namespace homeward
{

/** How a map compares with the world that it was made in. */
struct MissionTruth
{
  /** Share of the reachable space within 1.5 forward distances of a node and in its sight. */
  double coverage = 0.0;
  /** Edges without a collision-free way of up to twice the forward distance plus 1 m. */
  int falseEdges = 0;
  /** Pairs of nodes nearer than 0.5 m and in sight of each other. */
  int duplicateNodes = 0;
};

/** Metres that a node covers, in its sight. @param forwardDistance of the exploration, metres */
inline double coverageReach(double forwardDistance)
{
  return 1.5 * forwardDistance;
}

/**
 * Judges a map by the truth.
 * @param space of the world that the robot explored
 * @param start where the exploration began, metres: reachable space is what can be reached from it
 * @param nodes the robot's true pose when each node was made
 * @param edges which nodes the map joins; an edge of a node without a pose counts as false
 * @param forwardDistance of the exploration, metres
 */
MissionTruth judgeMission(const FreeSpace &space, const Eigen::Vector2d &start,
                          const std::map<NodeId, Pose2> &nodes,
                          const std::vector<std::pair<NodeId, NodeId>> &edges,
                          double forwardDistance);

/** As above; of `nodes`, those that the map does not have are left out. */
MissionTruth judgeMission(const FreeSpace &space, const Eigen::Vector2d &start,
                          const std::map<NodeId, Pose2> &nodes, const TopologicalMap &map,
                          double forwardDistance);

} // namespace homeward
