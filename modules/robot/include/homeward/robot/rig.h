// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace homeward
{

/** How fast the robot may move and how hard it may be pushed. All positive. */
struct Limits
{
  double maxSpeed = 0.4;         ///< m/s
  double maxTurnRate = 0.7;      ///< rad/s
  double acceleration = 0.3;     ///< m/s^2, of the translation
  double deceleration = 0.5;     ///< m/s^2, when it brakes
  double turnAcceleration = 1.7; ///< rad/s^2, of the rotation, both ways
};

/** What stands on the floor: which robot, which camera, and what is asked of them. */
struct Rig
{
  std::filesystem::path robot;  ///< URDF file, as written: relative to the rig file
  std::filesystem::path camera; ///< camera file, as written: relative to the rig file
  Limits limits;
};

/**
 * Reads the limits of a base: `max_speed_m_s`, `max_turn_rate_deg_s`, `acceleration_m_s2`,
 * `deceleration_m_s2`, `turn_acceleration_deg_s2`. What is left out keeps its default.
 * @throw ConfigError naming key, value and file: a key that is unknown, a value that is not a
 * positive number
 */
Limits parseLimits(const std::string &yaml, const std::string &origin);

/**
 * Reads a rig file: `robot: FILE`, `camera: FILE`, `limits: {...}` with the keys of parseLimits().
 * @param yaml its text
 * @param origin the file's name, for messages
 * @throw ConfigError naming key, value and file: a key that is unknown or missing, a limit that is
 * not a positive number
 */
Rig parseRig(const std::string &yaml, const std::string &origin);

} // namespace homeward
