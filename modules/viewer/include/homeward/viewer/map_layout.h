// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/topology/map.h>

namespace homeward
{

/**
 * Places for the nodes of a map whose true positions nobody knows: as far apart as the number of
 * edges between them, as well as the plane allows (stress majorization from classical scaling;
 * \cite Gansner2004). One edge is about one unit long. Headings are those that fit the edges'
 * bearings best, and of a layout and its mirror image the one that fits them better is given. The
 * same map always gets the same layout.
 */
std::map<NodeId, Pose2> layOut(const TopologicalMap &map);

} // namespace homeward
