// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/reconnect.h>

#include <algorithm>

namespace homeward
{
namespace
{

/** Lets so much of our time pass, less when stopped. */
void rest(Duration span, const std::atomic<bool> &stop)
{
  constexpr Duration kLook = std::chrono::milliseconds(20);
  SteadyClock wall;
  const Time end = wall.now() + span;
  while (!stop && wall.now() < end) {
    wall.sleepUntil(std::min(end, wall.now() + kLook));
  }
}

} // namespace

bool reconnect(PioneerBase &base, const PioneerBase::OpenLine &open,
               const ReconnectOptions &options, const std::atomic<bool> &stop,
               const std::function<void(const std::string &)> &say)
{
  if (options.tries < 1) {
    throw LogicError("reconnecting with " + std::to_string(options.tries) + " tries");
  }
  std::string failure;
  Duration pause = options.pause;
  for (int attempt = 1; !stop; ++attempt) {
    say("reconnecting, " + std::to_string(attempt) + " of " + std::to_string(options.tries) +
        (failure.empty() ? "" : ": " + failure));
    try {
      base.reconnect(open);
      return true;
    }
    catch (const DeviceError &error) {
      if (attempt >= options.tries) {
        throw;
      }
      failure = error.what();
    }
    rest(pause, stop);
    pause = std::min(2 * pause, options.longestPause);
  }
  return false;
}

} // namespace homeward
