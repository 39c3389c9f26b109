// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_argument.h"

#include <homeward/core/error.h>

namespace homeward
{

NodeId nodeOf(const MapFile &file, const std::string &numberOrName)
{
  const std::optional<NodeId> node = file.map().find(numberOrName);
  if (!node) {
    throw ConfigError("map " + file.path().string() + " has no node " + numberOrName +
                      "; `homeward map info` lists them");
  }
  return *node;
}

} // namespace homeward
