// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/store/map_file.h>

namespace homeward
{

/**
 * A map as text for comparing: header, places with their names, directions, edges with what came of
 * driving them, and the hash of each stored picture, in order of ids, numbers with six decimals
 * (radians, metres, seconds), no time of day, no run log, no journal. Two maps that grew alike give
 * the same text. The first line names the format's version.
 * @throw StoreError when a picture cannot be read
 */
std::string exportCanonical(const MapFile &file);

/** The graph as GraphML, with open directions and bearings as attributes. */
std::string exportGraphml(const TopologicalMap &map);

/** The graph for Graphviz; places with open directions have a double line. */
std::string exportDot(const TopologicalMap &map);

/** Header, graph and picture hashes as JSON; angles in radians. @throw StoreError */
std::string exportJson(const MapFile &file);

} // namespace homeward
