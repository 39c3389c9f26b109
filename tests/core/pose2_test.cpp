// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/pose2.h>
#include <homeward/core/random.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

constexpr int kRounds = 1000;

Pose2 anyPose(Random &random)
{
  return {random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0), random.uniform(-kPi, kPi)};
}

void expectSame(const Pose2 &a, const Pose2 &b, double tolerance = 1e-12)
{
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(wrapAngle(a.heading - b.heading), 0.0, tolerance);
}

TEST(Pose2, InverseUndoes)
{
  Random random(1, 0);
  for (int i = 0; i < kRounds; ++i) {
    const Pose2 aMb = anyPose(random);
    expectSame(aMb * aMb.inverse(), Pose2{});
    expectSame(aMb.inverse() * aMb, Pose2{});
  }
}

TEST(Pose2, CompositionIsAssociative)
{
  Random random(2, 0);
  for (int i = 0; i < kRounds; ++i) {
    const Pose2 aMb = anyPose(random);
    const Pose2 bMc = anyPose(random);
    const Pose2 cMd = anyPose(random);
    expectSame((aMb * bMc) * cMd, aMb * (bMc * cMd));
  }
}

TEST(Pose2, ActsOnPointsAsItComposes)
{
  Random random(3, 0);
  for (int i = 0; i < kRounds; ++i) {
    const Pose2 aMb = anyPose(random);
    const Pose2 bMc = anyPose(random);
    const Eigen::Vector2d cP(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0));
    EXPECT_LT(((aMb * bMc) * cP - aMb * (bMc * cP)).norm(), 1e-12);
  }
}

TEST(Pose2, HeadingTurnsCounterClockwise)
{
  const Pose2 wMr{1.0, 2.0, kPi / 2.0};
  const Eigen::Vector2d ahead = wMr * Eigen::Vector2d(1.0, 0.0);
  EXPECT_NEAR(ahead.x(), 1.0, 1e-12);
  EXPECT_NEAR(ahead.y(), 3.0, 1e-12);
}

TEST(Integrate, TimesAddUp)
{
  Random random(4, 0);
  for (int i = 0; i < kRounds; ++i) {
    const Twist2 twist{random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0)};
    const double t1 = random.uniform(0.0, 3.0);
    const double t2 = random.uniform(0.0, 3.0);
    expectSame(integrate(twist, t1) * integrate(twist, t2), integrate(twist, t1 + t2));
  }
}

TEST(Integrate, IsContinuousWhereItChangesFormula)
{
  for (const double w : {1e-9, 0.999e-6, 1.001e-6, 1e-5}) {
    const Pose2 end = integrate({1.0, w}, 1.0);
    EXPECT_NEAR(end.x, 1.0, 1e-10) << w;
    EXPECT_NEAR(end.y, w / 2.0, 1e-10) << w;
    EXPECT_DOUBLE_EQ(end.heading, w);
  }
}

TEST(Integrate, FullCircleEndsWhereItBegan)
{
  expectSame(integrate({0.5, 1.0}, 2.0 * kPi), Pose2{});
}

TEST(Integrate, SmallStepsApproachTheArc)
{
  const Twist2 twist{0.4, -0.7};
  Pose2 walked;
  for (int i = 0; i < 100000; ++i) {
    walked = walked * Pose2{twist.v * 2e-5, 0.0, twist.w * 2e-5};
  }
  expectSame(walked, integrate(twist, 2.0), 1e-4);
}

} // namespace
} // namespace homeward
