// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/steady_clock.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

TEST(SteadyClock, OfARateLivesSoMuchFaster)
{
  SteadyClock ours;
  SteadyClock quick(10.0);
  const Time begin = ours.now();
  const Time quickBegin = quick.now();
  quick.sleepUntil(quickBegin + std::chrono::seconds(1));
  const double passed = toSeconds(ours.now() - begin);
  const double quickPassed = toSeconds(quick.now() - quickBegin);
  EXPECT_GE(passed, 0.1);
  EXPECT_GE(quickPassed, 1.0);
  EXPECT_NEAR(quickPassed / passed, 10.0, 1.0);
}

TEST(SteadyClock, AllOfARateShowTheSameTime)
{
  const Time first = SteadyClock(3.0).now();
  const Time second = SteadyClock(3.0).now();
  EXPECT_GE(second, first);
  EXPECT_LT(toSeconds(second - first), 1.0);
}

} // namespace
} // namespace homeward
