// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/topology/reckoning.h>

#include <homeward/topology/planner.h>

#include <set>

namespace homeward
{

std::optional<Reckoned> reckon(const TopologicalMap &map, NodeId from, NodeId to)
{
  std::set<EdgeId> unknown;
  for (const auto &[id, edge] : map.edges()) {
    if (!edge.bearingAtA || !edge.bearingAtB || !edge.length) {
      unknown.insert(id);
    }
  }
  const auto path = shortestPath(map, from, to, unknown);
  if (!path) {
    return std::nullopt;
  }
  Reckoned reckoned;
  for (std::size_t i = 1; i < path->size(); ++i) {
    const NodeId a = (*path)[i - 1];
    const NodeId b = (*path)[i];
    const double length = *map.edgeBetween(a, b)->length;
    const double out = *map.departureBearing(a, b);
    const double back = *map.departureBearing(b, a);
    reckoned.fromMto = reckoned.fromMto * Pose2{length * std::cos(out), length * std::sin(out),
                                                wrapAngle(out + kPi - back)};
    reckoned.length += length;
  }
  return reckoned;
}

} // namespace homeward
