// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/arcos.h>
#include <homeward/robot/robot_description.h>

#include <string>
#include <vector>

namespace homeward
{

/** What an ARIA parameter file (`p3at.p`) says of a robot, as far as this project asks. */
struct AriaParameters
{
  std::string subclass;           ///< that the file is for
  ArcosUnits units;               ///< of the robot's numbers
  double width = 0.0;             ///< metres
  double length = 0.0;            ///< metres
  double maxSpeed = 0.0;          ///< m/s
  double maxTurnRate = 0.0;       ///< rad/s
  int switchToBaud = 0;           ///< 0: stays at 9600
  std::vector<SonarMount> sonars; ///< by the robot's index; heights are not in the file
};

/**
 * Reads a parameter file: lines `Key value ; comment`, in sections. Keys that are not asked for are
 * passed over; of keys that come once a laser or camera, the first counts.
 * @throw ConfigError naming file, line and key: a value that is no number, a unit that is missing
 * or not positive, a sonar with an index beyond 63
 */
AriaParameters parseAriaParameters(const std::string &text, const std::string &origin);

} // namespace homeward
