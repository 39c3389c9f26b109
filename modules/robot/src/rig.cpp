// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/robot/rig.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>
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

ConfigError unknownKey(const std::string &key, const std::string &origin)
{
  return ConfigError(origin + ": unknown key '" + key + "'");
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
      throw unknownKey(prefix + key, origin);
    }
    result.*(known->member) = positive(entry.second, prefix + key, origin) * known->unit;
  }
  return result;
}

/** One section of the file. Every key in it must have been asked for. */
class Section
{
public:
  Section(const YAML::Node &root, std::string name, std::string origin)
      : m_node(root[name]), m_name(std::move(name)), m_origin(std::move(origin))
  {
    if (!m_node) {
      throw ConfigError(m_origin + ": '" + m_name + "' is missing; base, laser and capture " +
                        "belong together");
    }
    if (!m_node.IsMap()) {
      throw ConfigError(m_origin + ": '" + m_name + "' is " + shown(m_node) +
                        "; a map is expected");
    }
  }

  /** Text that may be left out. */
  std::string text(const std::string &key, const std::string &fallback)
  {
    return m_node[key] ? text(key) : fallback;
  }

  std::string text(const std::string &key)
  {
    const YAML::Node value = take(key);
    if (!value || !value.IsScalar() || value.Scalar().empty()) {
      throw ConfigError(m_origin + ": '" + m_name + "." + key + "' is " +
                        (value ? shown(value) : "missing") + "; text is expected");
    }
    return value.Scalar();
  }

  double number(const std::string &key, double fallback) { return number(key).value_or(fallback); }

  std::optional<double> number(const std::string &key)
  {
    const YAML::Node value = take(key);
    return value ? std::optional(positive(value, m_name + "." + key, m_origin)) : std::nullopt;
  }

  /** A whole number from `least` on. */
  std::optional<int> count(const std::string &key, int least)
  {
    const YAML::Node value = take(key);
    int number = -1;
    if (!value) {
      return std::nullopt;
    }
    if (!value.IsScalar() || !YAML::convert<int>::decode(value, number) || number < least) {
      throw ConfigError(m_origin + ": '" + m_name + "." + key + "' is " + shown(value) +
                        "; a whole number from " + std::to_string(least) + " on is expected");
    }
    return number;
  }

  /** A number that is one of some hundredths, in hundredths; the first of them unless it is there.
   */
  int hundredths(const std::string &key, const std::vector<int> &choices)
  {
    constexpr double kNear = 1e-6;
    const double value = 100.0 * number(key, choices.front() / 100.0);
    for (const int choice : choices) {
      if (std::abs(value - choice) < kNear) {
        return choice;
      }
    }
    throw ConfigError(m_origin + ": '" + m_name + "." + key + "' is " + shown(m_node[key]) +
                      "; this laser has not got that resolution");
  }

  /** The value that the text of a key stands for. */
  template <class T>
  T choice(const std::string &key, const std::vector<std::pair<std::string, T>> &choices)
  {
    const std::string word = text(key);
    std::string known;
    for (const auto &[name, value] : choices) {
      if (name == word) {
        return value;
      }
      known += (known.empty() ? "" : ", ") + name;
    }
    throw ConfigError(m_origin + ": '" + m_name + "." + key + "' is '" + word + "'; one of " +
                      known + " is expected");
  }

  void refuseOthers() const
  {
    for (const auto &entry : m_node) {
      const std::string key = entry.first.Scalar();
      if (!m_taken.contains(key)) {
        throw unknownKey(m_name + "." + key, m_origin);
      }
    }
  }

private:
  YAML::Node take(const std::string &key)
  {
    m_taken.insert(key);
    return m_node[key];
  }

  const YAML::Node m_node; ///< const: looking a key up must not add it
  std::string m_name;
  std::string m_origin;
  std::set<std::string> m_taken;
};

BaseLink baseLink(const YAML::Node &root, const std::string &origin)
{
  Section section(root, "base", origin);
  BaseLink base;
  base.address = section.text("address");
  base.baud = section.count("baud", 1).value_or(base.baud);
  base.period = section.number("period_s", base.period);
  base.parameters = section.text("parameters", "");
  section.refuseOthers();
  return base;
}

LaserLink laserLink(const YAML::Node &root, const std::string &origin)
{
  using Kind = LaserLink::Kind;
  Section section(root, "laser", origin);
  LaserLink laser;
  laser.kind = section.choice<Kind>("kind", {{"lms200", Kind::Lms200},
                                             {"lms1xx", Kind::Lms1xx},
                                             {"hokuyo", Kind::Hokuyo},
                                             {"on_base", Kind::OnBase}});
  if (laser.kind == Kind::Lms200) {
    laser.baud = section.count("baud", 1).value_or(laser.baud);
  }
  if (laser.kind != Kind::OnBase) {
    laser.address = section.text("address");
  }
  if (laser.kind == Kind::Lms200) {
    laser.resolution = section.hundredths("resolution_deg", {100, 50});
  }
  if (laser.kind == Kind::Lms1xx) {
    laser.resolution = section.hundredths("resolution_deg", {50, 25});
  }
  laser.period = section.number("period_s", laser.period);
  section.refuseOthers();
  return laser;
}

CaptureLink captureLink(const YAML::Node &root, const std::string &origin)
{
  using Kind = CaptureLink::Kind;
  Section section(root, "capture", origin);
  CaptureLink capture;
  capture.kind = section.choice<Kind>("kind", {{"stream", Kind::Stream},
                                               {"v4l2", Kind::V4l2},
                                               {"firewire", Kind::Firewire},
                                               {"files", Kind::Files},
                                               {"film", Kind::Film}});
  capture.source = section.text("source");
  capture.period = section.number("period_s", capture.period);
  capture.latency = section.number("latency_s", capture.latency);
  if (capture.kind == Kind::V4l2) {
    if (const std::optional<double> milliseconds = section.number("exposure_ms")) {
      capture.exposure = *milliseconds / 1000.0;
    }
  }
  if (capture.kind == Kind::Firewire) {
    capture.shutter = section.count("shutter", 0);
  }
  if (capture.kind == Kind::V4l2 || capture.kind == Kind::Firewire) {
    capture.gain = section.count("gain", 0);
  }
  section.refuseOthers();
  return capture;
}

DeviceLinks deviceLinks(const YAML::Node &root, const std::string &origin)
{
  DeviceLinks devices{.base = baseLink(root, origin),
                      .laser = laserLink(root, origin),
                      .capture = captureLink(root, origin),
                      .stopJoystick = {}};
  if (root["stop_joystick"]) {
    devices.stopJoystick = file(root["stop_joystick"], "stop_joystick", origin);
  }
  if (root["clock_rate"]) {
    devices.clockRate = positive(root["clock_rate"], "clock_rate", origin);
  }
  return devices;
}

} // namespace

Limits parseLimits(const std::string &yaml, const std::string &origin)
{
  return limits(load(yaml, origin, "max_speed_m_s: 0.4"), "", origin);
}

Rig parseRig(const std::string &yaml, const std::string &origin)
{
  const YAML::Node root = load(yaml, origin, "robot: FILE");
  const std::set<std::string> kDeviceKeys = {"base", "laser", "capture", "stop_joystick",
                                             "clock_rate"};
  Rig rig;
  bool real = false;
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
    else if (kDeviceKeys.contains(key)) {
      real = true;
    }
    else {
      throw unknownKey(key, origin);
    }
  }
  if (rig.robot.empty() || rig.camera.empty()) {
    throw ConfigError(origin + ": '" + (rig.robot.empty() ? "robot" : "camera") + "' is missing");
  }
  if (real) {
    rig.devices = deviceLinks(root, origin);
  }
  return rig;
}

} // namespace homeward
