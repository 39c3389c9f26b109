// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/time.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

TEST(Time, SecondsComeBack)
{
  EXPECT_EQ(fromSeconds(1.5), std::chrono::milliseconds(1500));
  EXPECT_DOUBLE_EQ(toSeconds(fromSeconds(-0.25)), -0.25);
  EXPECT_DOUBLE_EQ(toSeconds(Time(fromSeconds(12.0))), 12.0);
}

TEST(Time, RoundsToTheNanosecond)
{
  for (int ms = -9999; ms < 10000; ++ms) {
    EXPECT_EQ(fromSeconds(ms / 1000.0), std::chrono::milliseconds(ms));
  }
}

} // namespace
} // namespace homeward
