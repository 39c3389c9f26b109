// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/steady_clock.h>

#include <thread>

namespace homeward
{

Time SteadyClock::now() const
{
  return Time(std::chrono::steady_clock::now().time_since_epoch());
}

void SteadyClock::sleepUntil(Time instant)
{
  std::this_thread::sleep_until(std::chrono::steady_clock::time_point(instant.time_since_epoch()));
}

} // namespace homeward
