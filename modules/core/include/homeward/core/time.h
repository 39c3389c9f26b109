// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace homeward
{

/** A span of robot time. */
using Duration = std::chrono::nanoseconds;

/** Names robot time: simulated or real, it starts at an arbitrary zero. Always an argument. */
struct RobotClockTag
{};

/** An instant of robot time. */
using Time = std::chrono::time_point<RobotClockTag, Duration>;

/** A span given in seconds, rounded to the nanosecond. */
inline Duration fromSeconds(double seconds)
{
  return std::chrono::round<Duration>(std::chrono::duration<double>(seconds));
}

/** A span in seconds. */
inline double toSeconds(Duration span)
{
  return std::chrono::duration<double>(span).count();
}

/** An instant in seconds since the clock's zero. */
inline double toSeconds(Time instant)
{
  return toSeconds(instant.time_since_epoch());
}

} // namespace homeward
