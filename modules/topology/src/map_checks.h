// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/topology/map_change.h>

namespace homeward
{

/** Throws the LogicError that names what breaks a rule of TopologicalMap. */
[[noreturn]] void refuse(const std::string &what);

/** "node 3", "edge 3", "direction 1 of node 3" */
std::string text(NodeId id);
std::string text(EdgeId id);
std::string text(NodeId node, DirectionId id);

/** Each throws a LogicError unless the values by themselves keep the rules of TopologicalMap. */
void checkDirections(const Node &node);
void checkNameText(NodeId id, const std::string &name);
void checkValues(const Edge &edge);
void checkStatistics(EdgeId id, const EdgeStatistics &statistics);

} // namespace homeward
