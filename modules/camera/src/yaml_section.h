// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/error.h>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace homeward
{

/** One mapping of the file, read key by key and refused by name. */
class Section
{
public:
  Section(const YAML::Node &node, std::string name, std::string origin,
          const std::vector<std::string> &known)
      : m_node(node), m_name(std::move(name)), m_origin(std::move(origin))
  {
    if (!m_node.IsDefined() || !m_node.IsMap()) {
      throw ConfigError(m_origin + ": " + m_name + " is missing or no mapping");
    }
    std::set<std::string> seen;
    for (const auto &entry : m_node) {
      const auto key = entry.first.as<std::string>();
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        throw ConfigError(m_origin + ": unknown key '" + key + "' in " + m_name);
      }
      if (!seen.insert(key).second) {
        throw ConfigError(m_origin + ": '" + key + "' stands twice in " + m_name);
      }
    }
  }

  double number(const std::string &key) const
  {
    const YAML::Node value = m_node[key];
    double number = 0.0;
    if (!value || !value.IsScalar() || !YAML::convert<double>::decode(value, number) ||
        !std::isfinite(number)) {
      throw ConfigError(m_origin + ": " + m_name + "." + key + " must be a number" + found(value));
    }
    return number;
  }

  double numberOr(const std::string &key, double fallback) const
  {
    return m_node[key] ? number(key) : fallback;
  }

  bool flag(const std::string &key) const
  {
    const YAML::Node value = m_node[key];
    bool flag = false;
    if (!value || !value.IsScalar() || !YAML::convert<bool>::decode(value, flag)) {
      throw ConfigError(m_origin + ": " + m_name + "." + key + " must be true or false" +
                        found(value));
    }
    return flag;
  }

private:
  /** What stands there instead, for messages. */
  static std::string found(const YAML::Node &value)
  {
    if (!value) {
      return ", and is missing";
    }
    return value.IsScalar() ? ", not '" + value.Scalar() + "'" : ", and is none";
  }

  YAML::Node m_node;
  std::string m_name;
  std::string m_origin;
};

/** A number of pixels of the section `image`. */
inline int pixels(const Section &image, const std::string &key, const std::string &origin)
{
  const double value = image.number(key);
  if (value < 1.0 || value > 65536.0 || value != std::floor(value)) {
    throw ConfigError(origin + ": image." + key + " must be a whole number of pixels, not " +
                      std::to_string(value));
  }
  return static_cast<int>(value);
}

} // namespace homeward
