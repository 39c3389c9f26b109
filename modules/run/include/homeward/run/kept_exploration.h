// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/explorer.h>
#include <homeward/store/map_file.h>

#include <optional>
#include <string>

namespace homeward
{

/** Under this key of a map file's values stands the exploration that makes the map. */
inline constexpr const char *kExplorationKey = "exploration";

/** A state as JSON in one line, which says the version of its form. */
std::string explorerStateJson(const ExplorerState &state);

/**
 * Inverse of explorerStateJson(). What a text of an older program lacks has its default.
 * @throw ConfigError, in one line, for a newer version, an unknown key or a value that is none
 */
ExplorerState parseExplorerState(const std::string &text);

/**
 * The state of the last step that a map file holds; nothing in a map that no exploration has kept
 * its state in. @throw StoreError naming the file when it cannot be understood
 */
std::optional<ExplorerState> keptExploration(const MapFile &file);

} // namespace homeward
