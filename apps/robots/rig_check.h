// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "real_robot.h"

#include <atomic>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace homeward
{

/** What a check of one device found. */
struct Finding
{
  std::string device; ///< "base", "laser", "camera" or "motion"
  bool good = true;
  std::string text; ///< one line
};

/** Listens to every device for so many seconds of robot time; nothing moves. */
std::vector<Finding> checkDevices(const RobotFiles &files, double seconds);

/**
 * Turns left by 30 degrees and drives 15 cm ahead, and compares what odometry, laser and camera say
 * of it. The robot stands afterwards.
 * @param stop ends it
 * @throw DeviceError when a device is gone, RuntimeError when it was stopped
 */
std::vector<Finding> checkMotion(const RobotFiles &files, const std::atomic<bool> &stop);

/**
 * The turn of a laser between two scans from the same place, by the best agreement of their ranges.
 * @return radians, counter-clockwise, within 60 degrees either way
 */
double turnBetween(const Scan &before, const Scan &after);

/** What the findings of a motion check are drawn from. */
struct MotionSeen
{
  double odometryTurn = 0.0;    ///< radians, counter-clockwise
  double laserTurn = 0.0;       ///< likewise
  double cameraTurn = 0.0;      ///< likewise; NaN when the pictures do not tell
  double odometryAdvance = 0.0; ///< metres ahead
  double laserAdvance = 0.0;    ///< metres that the way ahead became shorter; NaN where it is open
};

/** Says which of odometry, laser and camera disagree, and what that means. */
std::vector<Finding> judgeMotion(const MotionSeen &seen);

} // namespace homeward
