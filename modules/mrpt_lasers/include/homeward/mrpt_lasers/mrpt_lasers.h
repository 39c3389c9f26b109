// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/time.h>
#include <homeward/robot/laser_scanner.h>

#include <chrono>
#include <memory>
#include <string>

namespace homeward
{

/** How a laser that MRPT drives is used. */
struct MrptLaserOptions
{
  Duration start = std::chrono::seconds(10);  ///< within which the first scan comes
  Duration silence = std::chrono::seconds(2); ///< robot time without a scan: it counts as gone
  double clockRate = 1.0;                     ///< see SteadyClock
};

/**
 * A Hokuyo laser, with the field of view and the step that it has. Scans are stamped when they
 * came.
 * @param address `tcp:HOST:PORT`, or the path of a serial line
 * @throw ConfigError when the address is neither; DeviceError when no scan comes
 */
std::unique_ptr<LaserScanner> openHokuyo(const std::string &address,
                                         const MrptLaserOptions &options = {});

/**
 * A SICK LMS-2xx at 38400 baud, 180 degrees, in millimetres. Scans are stamped when they came.
 * @param path of the serial line
 * @param resolution hundredths of a degree: 100 or 50
 * @throw DeviceError when no scan comes
 */
std::unique_ptr<LaserScanner> openMrptSick(const std::string &path, int resolution = 100,
                                           const MrptLaserOptions &options = {});

} // namespace homeward
