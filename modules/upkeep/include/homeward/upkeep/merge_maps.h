// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/upkeep/same_places.h>

namespace homeward
{

/**
 * Writes a new map with all of two: a copy of `a`, to which the places and ways of `b` are added
 * with new ids; then those of `pairs` are merged (NodesMerged). Places of `b` keep the headings
 * that they were stored with, and their names where those are free. Neither `a` nor `b` is changed;
 * the new file appears when it is complete.
 * @return which node of the new map each node of `b` became
 * @throw StoreError when the maps were made with different cameras or panoramas, or the file exists
 * and may not be replaced, or cannot be written
 */
std::map<NodeId, NodeId> mergeMaps(const MapFile &a, const MapFile &b,
                                   const std::vector<PlacePair> &pairs,
                                   const std::filesystem::path &output,
                                   MapFile::IfExists ifExists = MapFile::IfExists::Refuse);

} // namespace homeward
