// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/random.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

TEST(Angle, WrappedLiesInTheHalfOpenTurn)
{
  Random random(1, 0);
  for (int i = 0; i < 10000; ++i) {
    const double wrapped = wrapAngle(random.uniform(-100.0, 100.0));
    EXPECT_GE(wrapped, -kPi);
    EXPECT_LT(wrapped, kPi);
  }
}

TEST(Angle, WrappingChangesWholeTurnsOnly)
{
  Random random(2, 0);
  for (int i = 0; i < 10000; ++i) {
    const double angle = random.uniform(-100.0, 100.0);
    const double turns = (angle - wrapAngle(angle)) / (2.0 * kPi);
    EXPECT_NEAR(turns, std::round(turns), 1e-12);
  }
}

TEST(Angle, WrappingTwiceIsWrappingOnce)
{
  for (const double angle : {-7.0, -kPi, -1.0, 0.0, 1.0, kPi, 7.0, 3.0 * kPi}) {
    EXPECT_EQ(wrapAngle(wrapAngle(angle)), wrapAngle(angle)) << angle;
  }
}

TEST(Angle, HalfATurnIsWrittenWithItsLowerEnd)
{
  EXPECT_EQ(wrapAngle(kPi), -kPi);
  EXPECT_EQ(wrapAngle(-kPi), -kPi);
}

TEST(Angle, DegreesAndRadiansAreInverse)
{
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  for (const double angle : {-720.0, -1.5, 0.0, 57.3, 360.0}) {
    EXPECT_NEAR(degrees(radians(angle)), angle, 1e-12);
  }
}

} // namespace
} // namespace homeward
