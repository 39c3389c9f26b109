// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/pilot/turn_calibration.h>

#include <gtest/gtest.h>

#include <random>

namespace homeward
{
namespace
{

/** Turns in steps, as the base counts them. */
void turn(TurnCalibration &odometry, Pose2 &raw, double angle)
{
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    raw.heading = wrapAngle(raw.heading + angle / kSteps);
    odometry.follow(raw);
  }
}

TEST(TurnCalibration, untaughtSaysWhatTheBaseSays)
{
  TurnCalibration odometry;
  Pose2 raw{1.0, 2.0, 0.5};
  odometry.follow(raw);
  for (int i = 0; i < 20; ++i) {
    raw = raw * Pose2{0.05, 0.0, 0.3};
    const Pose2 pose = odometry.follow(raw);
    EXPECT_NEAR(pose.x, raw.x, 1e-12);
    EXPECT_NEAR(pose.y, raw.y, 1e-12);
    EXPECT_NEAR(wrapAngle(pose.heading - raw.heading), 0.0, 1e-12);
  }
  EXPECT_NEAR(odometry.turned(), 6.0, 1e-9);
}

TEST(TurnCalibration, learnsHowMuchTurnsSkid)
{
  constexpr double kShare = 0.09;
  TurnCalibration odometry;
  std::mt19937 random(1);
  std::normal_distribution<double> view(0.0, radians(2.0));
  std::uniform_real_distribution<double> angle(-5.0, 5.0);
  Pose2 raw;
  double truth = odometry.follow(raw).heading;
  for (int i = 0; i < 8; ++i) {
    const double before = odometry.turned();
    const Pose2 from = odometry.follow(raw);
    const double turned = angle(random);
    turn(odometry, raw, turned);
    truth = (1.0 - kShare) * turned;
    const double said = wrapAngle(odometry.follow(raw).heading - from.heading);
    odometry.learn(odometry.turned() - before, wrapAngle(truth - said) + view(random));
  }
  EXPECT_NEAR(odometry.share(), kShare, 0.01);
  const Pose2 from = odometry.follow(raw);
  turn(odometry, raw, kPi / 2.0);
  EXPECT_NEAR(wrapAngle(odometry.follow(raw).heading - from.heading), (1.0 - kShare) * kPi / 2.0,
              radians(1.0));
}

TEST(TurnCalibration, aViewMistakenTeachesNothing)
{
  TurnCalibration odometry;
  EXPECT_FALSE(odometry.learn(1.0, radians(40.0)));
  EXPECT_EQ(odometry.share(), 0.0);
  EXPECT_TRUE(odometry.learn(6.0, radians(-30.0))); // skidding explains it
  EXPECT_GT(odometry.share(), 0.05);
}

} // namespace
} // namespace homeward
