// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/pioneer_base.h>

#include <atomic>
#include <functional>
#include <string>

namespace homeward
{

/** How often and how fast a lost base is called again. */
struct ReconnectOptions
{
  int tries = 8;                                             ///< at least 1
  Duration pause = std::chrono::milliseconds(500);           ///< before the second try, then double
  Duration longestPause = std::chrono::milliseconds(10'000); ///< but no longer than this
};

/**
 * Tries PioneerBase::reconnect() until it has the robot back, whose motors stay off until
 * PioneerBase::enableMotors().
 * @param stop ends it between two tries and during a pause
 * @param say is told before each try which one it is, and why the one before failed
 * @return false when it was stopped
 * @throw DeviceError after the last try, with its reason; LogicError without tries
 */
bool reconnect(PioneerBase &base, const PioneerBase::OpenLine &open,
               const ReconnectOptions &options, const std::atomic<bool> &stop,
               const std::function<void(const std::string &)> &say);

} // namespace homeward
