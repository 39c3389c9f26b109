// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/command.h>
#include <homeward/topology/map.h>

#include <string>
#include <vector>

namespace homeward
{

/**
 * What one report leads to. The changes go into the map, in one transaction with the log lines,
 * before the command is given.
 */
template <class State> struct Step
{
  State state;                    ///< after it
  Command command;                ///< to carry out next
  std::vector<MapChange> changes; ///< of the map
  std::vector<std::string> log;   ///< lines of the seed's tables, "State | Node | Dissimilarity"
  std::vector<NodeId> refreshes = {}; ///< nodes to be known by what was seen anew there from now on
};

} // namespace homeward
