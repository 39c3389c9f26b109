// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/store/map_file.h>

#include <string>

namespace homeward
{

/** The node that the user names. @throw ConfigError when the map has none of that number or name */
NodeId nodeOf(const MapFile &file, const std::string &numberOrName);

} // namespace homeward
