// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/velocity_rounder.h>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace homeward
{
namespace
{

/** 400 mm/s, and 40.1 deg/s, of which 40 are whole. */
constexpr Limits kLimits{0.4, 0.7, 0.3, 0.5, 1.7};
constexpr int kMostSpeed = 400;
constexpr int kMostTurn = 40;

TEST(VelocityRounder, TheMeanOfWhatIsSentIsWhatIsWanted)
{
  constexpr int kCommands = 200;
  for (double units = -39.9; units < 40.0; units += 0.37) {
    VelocityRounder rounder(kLimits);
    double speed = 0.0;
    double turn = 0.0;
    for (int i = 1; i <= kCommands; ++i) {
      const WholeVelocity sent = rounder.next({units / 1000.0, radians(units)});
      EXPECT_LT(std::abs(sent.speed - units), 1.0);
      speed += sent.speed;
      turn += sent.turnRate;
      // Half a unit is behind at any time, not only in the long run.
      ASSERT_NEAR(speed, i * units, 0.5 + 1e-9);
      ASSERT_NEAR(turn, i * units, 0.5 + 1e-9);
    }
  }
}

TEST(VelocityRounder, WholeUnitsGoAsTheyAre)
{
  VelocityRounder rounder(kLimits);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(rounder.next({0.2, radians(-10.0)}), (WholeVelocity{200, -10}));
  }
}

TEST(VelocityRounder, NoLimitIsPassedNotEvenByAPart)
{
  VelocityRounder rounder(kLimits);
  double turn = 0.0;
  for (int i = 0; i < 100; ++i) {
    const WholeVelocity sent = rounder.next({0.3999, kLimits.maxTurnRate});
    EXPECT_LE(sent.speed, kMostSpeed);
    EXPECT_LE(sent.turnRate, kMostTurn);
    turn += sent.turnRate;
  }
  EXPECT_DOUBLE_EQ(turn, 100.0 * kMostTurn);
  EXPECT_EQ(rounder.next({-9.0, 9.0}), (WholeVelocity{-kMostSpeed, kMostTurn}));
}

TEST(VelocityRounder, ZeroIsZeroAndForgetsWhatWasCarried)
{
  VelocityRounder rounder(kLimits);
  const Twist2 slow{0.0004, radians(0.4)}; // rounds to nothing, then to one
  EXPECT_EQ(rounder.next(slow), (WholeVelocity{0, 0}));
  EXPECT_EQ(rounder.next({}), (WholeVelocity{0, 0}));
  EXPECT_EQ(rounder.next(slow), (WholeVelocity{0, 0}));
  EXPECT_EQ(rounder.next(slow), (WholeVelocity{1, 1}));
  EXPECT_EQ(rounder.next({}), (WholeVelocity{0, 0}));
  // One axis stands while the other goes on.
  EXPECT_EQ(rounder.next(slow), (WholeVelocity{0, 0}));
  EXPECT_EQ(rounder.next({0.0, slow.w}), (WholeVelocity{0, 1}));
  EXPECT_EQ(rounder.next(slow).speed, 0);
  rounder.forget();
  EXPECT_EQ(rounder.next(slow), (WholeVelocity{0, 0}));
}

TEST(VelocityRounder, NoSignIsTurnedRoundAndNoLimitPassedWhateverComes)
{
  VelocityRounder rounder(kLimits);
  std::mt19937 random(1);
  std::normal_distribution<double> size(0.0, 1.0);
  std::uniform_real_distribution<double> scale(-9.0, 2.0);
  const auto draw = [&] { return size(random) * std::pow(10.0, scale(random)); };
  for (int i = 0; i < 20000; ++i) {
    const double speed = draw();
    const double turn = draw();
    const WholeVelocity sent = rounder.next({speed, radians(turn)});
    ASSERT_GE(sent.speed * speed, 0.0) << speed;
    ASSERT_GE(sent.turnRate * turn, 0.0) << turn;
    ASSERT_LE(std::abs(sent.speed), kMostSpeed);
    ASSERT_LE(std::abs(sent.turnRate), kMostTurn);
  }
}

TEST(VelocityRounder, WhatIsCarriedNeitherTurnsASignRoundNorPassesALimit)
{
  const auto after = [](double units, double then) {
    VelocityRounder rounder(kLimits);
    rounder.next({units / 1000.0, radians(units)}); // leaves half a unit
    return rounder.next({then / 1000.0, radians(then)});
  };
  EXPECT_EQ(after(0.5, 1e-20), (WholeVelocity{0, 0}));
  EXPECT_EQ(after(-0.5, -1e-20), (WholeVelocity{0, 0}));
  EXPECT_EQ(after(-0.5, 9999.0), (WholeVelocity{kMostSpeed, kMostTurn}));
  EXPECT_EQ(after(0.5, -9999.0), (WholeVelocity{-kMostSpeed, -kMostTurn}));
}

TEST(VelocityRounder, WhatIsNotFiniteIsRefused)
{
  VelocityRounder rounder(kLimits);
  EXPECT_THROW(rounder.next({std::nan(""), 0.0}), LogicError);
  EXPECT_THROW(rounder.next({0.0, std::numeric_limits<double>::infinity()}), LogicError);
}

} // namespace
} // namespace homeward
