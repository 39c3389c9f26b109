// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace homeward
{

/** What was looked at in a map file, and what is wrong with it. */
struct MapCheck
{
  std::size_t nodes = 0;                  ///< of the map
  std::size_t edges = 0;                  ///< of the map
  std::size_t pictures = 0;               ///< sound ones
  std::vector<std::string> findings = {}; ///< one line each; empty: it is sound
};

/**
 * Looks at a whole map file without changing it: its version, the database's pages, rows that name
 * others, the header, the rules of TopologicalMap, and of every place that its picture is there,
 * has not changed and decodes to the header's geometry. What cannot be read is a finding too.
 */
MapCheck checkMap(const std::filesystem::path &path);

} // namespace homeward
