// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <tinyxml2.h>

namespace homeward
{

/** Number of children of one name. */
inline int childCount(const tinyxml2::XMLElement &parent, const std::string &name)
{
  int number = 0;
  for (const auto *child = parent.FirstChildElement(name.c_str()); child != nullptr;
       child = child->NextSiblingElement(name.c_str())) {
    ++number;
  }
  return number;
}

} // namespace homeward
