// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/steady_clock.h>

#include <thread>

namespace homeward
{
namespace
{

using Machine = std::chrono::steady_clock;

/** Nanoseconds times a factor. */
std::chrono::nanoseconds scaled(std::chrono::nanoseconds span, double factor)
{
  return std::chrono::round<std::chrono::nanoseconds>(
      std::chrono::duration<double, std::nano>(span) * factor);
}

} // namespace

Time SteadyClock::now() const
{
  return Time(scaled(Machine::now().time_since_epoch(), m_rate));
}

void SteadyClock::sleepUntil(Time instant)
{
  // Rounding may wake it a nanosecond early.
  for (Time before = now(); before < instant; before = now()) {
    std::this_thread::sleep_for(scaled(instant - before, 1.0 / m_rate));
  }
}

} // namespace homeward
