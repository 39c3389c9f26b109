// SPDX-License-Identifier: GPL-3.0-or-later
// Where the tutorials find the data that ships with Homeward.
#pragma once

#include <homeward/core/error.h>

#include <fstream>
#include <iterator>
#include <string>

/** A file of the installed data; linking homeward::data says where that is. */
inline std::string dataFile(const std::string &name)
{
  return std::string(HOMEWARD_DATA_DIR) + "/" + name;
}

/** Its text: Homeward's parsers take text, so that a camera may come from anywhere. */
inline std::string readText(const std::string &file)
{
  std::ifstream stream(file);
  if (!stream) {
    throw homeward::ConfigError("cannot read " + file);
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}
