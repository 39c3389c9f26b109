// SPDX-License-Identifier: GPL-3.0-or-later
#include "fault_drive.h"

#include <sys/syscall.h>
#include <sys/time.h>

namespace
{

/** Seconds that the wall clock of this process goes ahead of the machine's. */
std::atomic<std::time_t> wallClockAhead{0};

} // namespace

// Every library in this process asks these for the time.
extern "C" int clock_gettime(clockid_t clock, timespec *time) noexcept
{
  const auto result = static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  if (result == 0 && clock == CLOCK_REALTIME) {
    time->tv_sec += wallClockAhead;
  }
  return result;
}

extern "C" int gettimeofday(timeval *time, void * /*zone*/) noexcept
{
  timespec now{};
  const int result = clock_gettime(CLOCK_REALTIME, &now);
  *time = {now.tv_sec, now.tv_nsec / 1000};
  return result;
}

namespace homeward
{
namespace
{

class ClockFault : public Fault
{
protected:
  ~ClockFault() override { wallClockAhead = 0; }
};

TEST_F(ClockFault, TheWallClockJumps)
{
  connect();
  const auto before = std::chrono::system_clock::now();
  for (const std::time_t ahead : {3600, -3600}) {
    wallClockAhead = ahead;
    ASSERT_EQ(std::chrono::system_clock::now() > before, ahead > 0);
    const auto begin = Wall::now();
    while (Seconds(Wall::now() - begin).count() < 0.6) {
      m_motion->tick();
      m_motion->follow({0.3, 0.0}, 0.0);
    }
    EXPECT_FALSE(m_wire.zero()) << "it stopped for a clock that says nothing to it";
  }
  silence("base", "has been silent", "the wall clock jumps by an hour, then the base falls silent");
}

} // namespace
} // namespace homeward
