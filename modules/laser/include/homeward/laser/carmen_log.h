// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/scan.h>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace homeward
{

/** One front laser line of a log. */
struct CarmenScan
{
  Scan scan;         ///< in the laser's frame, stamped with `time`
  Pose2 pose;        ///< of the laser in the log's frame, as its writer knew it
  Pose2 odometry;    ///< of the robot in the odometry frame
  double time = 0.0; ///< s, when it was measured; logs step back by a second at times
};

/** What a log holds of interest here. */
struct CarmenLog
{
  std::vector<CarmenScan> scans; ///< in the order of the file
  std::size_t odometryLines = 0; ///< how many
};

/**
 * Reads a CARMEN text log, plain or compressed by gzip.
 *
 *     FLASER n r_1 ... r_n x y theta odom_x odom_y odom_theta ipc_timestamp host logger_timestamp
 *
 * n is 180 or 181 (a degree apart) or 360 or 361 (half a degree), from -90 degrees (right) on.
 * ODOM lines are counted, all others skipped. What the sensor can see is not in the log: rangeMax
 * is the least of 8, 16, 32, 50 and 80 m (SICK's settings) whose codes for "no echo", up
 * to 8.2, 16.4, 32.8, 51.2 and 82 m, hold the log's largest reading; readings at or beyond it are
 * far and open.
 *
 * @throw ConfigError with file and line: unreadable, damaged or cut short, no line of a log in it,
 * or an FLASER line that does not fit the format
 */
CarmenLog readCarmenLog(const std::filesystem::path &file);

} // namespace homeward
