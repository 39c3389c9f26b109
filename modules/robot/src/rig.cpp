// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/robot/rig.h>

#include <algorithm>
#include <cmath>
#include <yaml-cpp/yaml.h>

namespace homeward
{
namespace
{

struct LimitKey
{
  const char *key;
  double Limits::*member;
  double unit; ///< SI value of one of what the file counts in
};

constexpr LimitKey kLimitKeys[] = {
    {"max_speed_m_s", &Limits::maxSpeed, 1.0},
    {"max_turn_rate_deg_s", &Limits::maxTurnRate, radians(1.0)},
    {"acceleration_m_s2", &Limits::acceleration, 1.0},
    {"deceleration_m_s2", &Limits::deceleration, 1.0},
    {"turn_acceleration_deg_s2", &Limits::turnAcceleration, radians(1.0)},
};

/** The document, a map of keys such as `example`. */
YAML::Node load(const std::string &yaml, const std::string &origin, const std::string &example)
{
  try {
    YAML::Node root = YAML::Load(yaml);
    if (!root.IsMap()) {
      throw ConfigError(origin + ": no keys and values; lines like '" + example + "' are expected");
    }
    return root;
  }
  catch (const YAML::Exception &exception) {
    throw ConfigError(origin + ": not YAML: " + exception.what());
  }
}

/** What the file says, for a message. */
std::string shown(const YAML::Node &value)
{
  return value.IsScalar() ? "'" + value.Scalar() + "'" : "a list, a map or nothing";
}

std::filesystem::path file(const YAML::Node &value, const std::string &key,
                           const std::string &origin)
{
  if (!value.IsScalar() || value.Scalar().empty()) {
    throw ConfigError(origin + ": '" + key + "' is " + shown(value) + "; name a file");
  }
  return value.Scalar();
}

double positive(const YAML::Node &value, const std::string &key, const std::string &origin)
{
  double number = 0.0;
  if (!value.IsScalar() || !YAML::convert<double>::decode(value, number) ||
      !std::isfinite(number) || number <= 0.0) {
    throw ConfigError(origin + ": '" + key + "' is " + shown(value) +
                      "; a positive number is expected");
  }
  return number;
}

/** @param prefix of every key in messages */
Limits limits(const YAML::Node &node, const std::string &prefix, const std::string &origin)
{
  Limits result;
  for (const auto &entry : node) {
    const std::string key = entry.first.Scalar();
    const auto *known = std::find_if(std::begin(kLimitKeys), std::end(kLimitKeys),
                                     [&](const LimitKey &each) { return key == each.key; });
    if (known == std::end(kLimitKeys)) {
      throw ConfigError(origin + ": unknown key '" + prefix + key + "'");
    }
    result.*(known->member) = positive(entry.second, prefix + key, origin) * known->unit;
  }
  return result;
}

} // namespace

Limits parseLimits(const std::string &yaml, const std::string &origin)
{
  return limits(load(yaml, origin, "max_speed_m_s: 0.4"), "", origin);
}

Rig parseRig(const std::string &yaml, const std::string &origin)
{
  const YAML::Node root = load(yaml, origin, "robot: FILE");
  Rig rig;
  for (const auto &entry : root) {
    const std::string key = entry.first.Scalar();
    if (key == "robot") {
      rig.robot = file(entry.second, key, origin);
    }
    else if (key == "camera") {
      rig.camera = file(entry.second, key, origin);
    }
    else if (key == "limits") {
      if (!entry.second.IsMap()) {
        throw ConfigError(origin + ": 'limits' is " + shown(entry.second) + "; a map is expected");
      }
      rig.limits = limits(entry.second, "limits.", origin);
    }
    else {
      throw ConfigError(origin + ": unknown key '" + key + "'");
    }
  }
  if (rig.robot.empty() || rig.camera.empty()) {
    throw ConfigError(origin + ": '" + (rig.robot.empty() ? "robot" : "camera") + "' is missing");
  }
  return rig;
}

} // namespace homeward
