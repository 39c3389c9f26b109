// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/topology/map.h>

#include <optional>

namespace homeward
{

/** Where a node stands by the ways that were driven. */
struct Reckoned
{
  Pose2 fromMto;       ///< metres; heading as stored with the nodes
  double length = 0.0; ///< metres of way it was reckoned over; the error grows with it
};

/**
 * Chains the bearings and lengths of the edges on a path with the fewest edges; those that lack one
 * are not used.
 * @return nothing when no such path exists
 */
std::optional<Reckoned> reckon(const TopologicalMap &map, NodeId from, NodeId to);

} // namespace homeward
