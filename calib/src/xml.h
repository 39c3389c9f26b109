// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace homeward
{

/** An element: no more of XML than camera files use. Attributes and comments are skipped. */
struct XmlElement
{
  std::string name;
  std::string text;
  std::vector<XmlElement> children;

  /** The first child of a name, or nullptr. */
  const XmlElement *child(const std::string &childName) const;
};

/** The root element. @throw ConfigError with the line where it is no XML */
XmlElement parseXml(const std::string &text, const std::string &origin);

/** The number in a child. @throw ConfigError when it is missing or none */
double xmlNumber(const XmlElement &element, const std::string &child, const std::string &origin);

} // namespace homeward
