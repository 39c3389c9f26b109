// SPDX-License-Identifier: GPL-3.0-or-later
#include "ideal_base.h"

#include <homeward/core/error.h>
#include <homeward/visp_base/base_robot.h>
#include <homeward/visp_base/visp_base.h>

#include <gtest/gtest.h>
#include <visp3/robot/vpRobotException.h>
#include <visp3/robot/vpSimulatorPioneer.h>

#include <limits>

namespace homeward
{
namespace
{

/** vpSimulatorPioneer, which moves on by one period at each command. */
class SimulatedByVisp : public testing::Test
{
protected:
  static constexpr double kPeriod = 0.04; // s

  SimulatedByVisp() { pioneer.setSamplingTime(kPeriod); }

  void drive(const Twist2 &twist, int periods)
  {
    for (int i = 0; i < periods; ++i) {
      base.drive(twist);
      clock.sleepUntil(clock.now() + fromSeconds(kPeriod));
    }
  }

  HandClock clock;
  vpSimulatorPioneer pioneer;
  VispBase base{pioneer, clock, {vpRobot::ARTICULAR_FRAME, pioneer.get_cMe(), {}}};
};

TEST_F(SimulatedByVisp, StandsAtTheOriginAtFirst)
{
  const BaseState state = base.state();
  EXPECT_NEAR(state.odometry.x, 0.0, 1e-9);
  EXPECT_NEAR(state.odometry.y, 0.0, 1e-9);
  EXPECT_NEAR(state.odometry.heading, 0.0, 1e-9);
  EXPECT_EQ(state.velocity.v, 0.0);
}

TEST_F(SimulatedByVisp, DrivesForwardInMetresASecond)
{
  base.state();
  drive({0.15, 0.0}, 50);
  const BaseState state = base.state();
  EXPECT_NEAR(state.odometry.x, 0.3, 1e-6);
  EXPECT_NEAR(state.odometry.y, 0.0, 1e-6);
  EXPECT_NEAR(state.velocity.v, 0.15, 1e-6);
  EXPECT_NEAR(state.velocity.w, 0.0, 1e-6);
  EXPECT_EQ(state.stamp, Time{} + fromSeconds(2.0));
}

TEST_F(SimulatedByVisp, TurnsCounterClockwiseAndDrivesBackwards)
{
  drive({0.0, 0.5}, 50);
  EXPECT_NEAR(base.state().odometry.heading, 1.0, 1e-6);
  drive({-0.1, -0.25}, 25);
  const Pose2 expected = Pose2{0.0, 0.0, 1.0} * integrate({-0.1, -0.25}, 1.0);
  const BaseState state = base.state();
  // ViSP's simulator takes the heading of each period's beginning.
  EXPECT_NEAR(state.odometry.x, expected.x, 2e-3);
  EXPECT_NEAR(state.odometry.y, expected.y, 2e-3);
  EXPECT_NEAR(state.odometry.heading, 0.75, 1e-6);
  EXPECT_NEAR(state.velocity.v, -0.1, 1e-3);
  EXPECT_NEAR(state.velocity.w, -0.25, 1e-6);
}

TEST_F(SimulatedByVisp, KeepsTheRobotsOwnLimits)
{
  pioneer.setMaxTranslationVelocity(0.1);
  drive({0.4, 0.0}, 25);
  EXPECT_NEAR(base.state().odometry.x, 0.1, 1e-6);
}

TEST_F(SimulatedByVisp, WhatTheRobotRefusesIsADeviceError)
{
  VispBase other(pioneer, clock); // in the frame that ViSP's simulator does not know
  EXPECT_THROW(other.drive({0.1, 0.0}), DeviceError);
}

vpColVector twist(double v, double w)
{
  vpColVector velocity(2);
  velocity[0] = v;
  velocity[1] = w;
  return velocity;
}

TEST(BaseRobot, DrivesForwardAndCounterClockwise)
{
  IdealBase base;
  BaseRobot robot(base);
  robot.setVelocity(vpRobot::REFERENCE_FRAME, twist(0.1, -0.3));
  EXPECT_DOUBLE_EQ(base.told.velocity.v, 0.1);
  EXPECT_DOUBLE_EQ(base.told.velocity.w, -0.3);
  const vpColVector measured = robot.getVelocity(vpRobot::REFERENCE_FRAME);
  EXPECT_DOUBLE_EQ(measured[0], 0.1);
  EXPECT_DOUBLE_EQ(measured[1], -0.3);
}

TEST(BaseRobot, ScalesDownWhatIsAboveItsMaximum)
{
  IdealBase base;
  BaseRobot robot(base);
  robot.setMaxTranslationVelocity(0.5);
  robot.setVelocity(vpRobot::REFERENCE_FRAME, twist(1.0, 0.4));
  EXPECT_DOUBLE_EQ(base.told.velocity.v, 0.5);
  EXPECT_DOUBLE_EQ(base.told.velocity.w, 0.2); // the same arc
}

TEST(BaseRobot, TellsWhereItsCameraIs)
{
  IdealBase base;
  base.told.odometry = {1.0, 2.0, 0.5};
  BaseRobot robot(base);
  const vpColVector own = robot.getPosition(vpRobot::REFERENCE_FRAME);
  ASSERT_EQ(own.size(), 6U);
  EXPECT_NEAR(own[0], 1.0, 1e-12);
  EXPECT_NEAR(own[1], 2.0, 1e-12);
  EXPECT_NEAR(own[5], 0.5, 1e-12);

  // 0.2 m ahead of the middle and 0.9 m up.
  robot.set_cMe(vpHomogeneousMatrix(-0.2, 0.0, -0.9, 0.0, 0.0, 0.0));
  const vpColVector camera = robot.getPosition(vpRobot::REFERENCE_FRAME);
  EXPECT_NEAR(camera[0], 1.0 + 0.2 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(camera[1], 2.0 + 0.2 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(camera[2], 0.9, 1e-12);
}

TEST(BaseRobot, TellsHowItHasMovedSinceItWasAsked)
{
  IdealBase base;
  base.told.odometry = {1.0, 2.0, 0.5};
  BaseRobot robot(base);
  robot.setVelocity(vpRobot::REFERENCE_FRAME, twist(0.1, 0.3));
  base.move(2.0);
  vpColVector moved;
  for (const double seconds : {2.0, 0.0}) {
    robot.getDisplacement(vpRobot::REFERENCE_FRAME, moved);
    const Pose2 expected = integrate({0.1, 0.3}, seconds);
    ASSERT_EQ(moved.size(), 3U);
    EXPECT_NEAR(moved[0], expected.x, 1e-12);
    EXPECT_NEAR(moved[1], expected.y, 1e-12);
    EXPECT_NEAR(moved[2], expected.heading, 1e-12);
  }
}

TEST(BaseRobot, JacobiansSayHowItsFramesMove)
{
  IdealBase base;
  base.told.odometry = {0.0, 0.0, 0.5};
  BaseRobot robot(base);
  const vpColVector inRobot = robot.get_eJe() * twist(0.1, 0.3);
  EXPECT_NEAR(inRobot[0], 0.1, 1e-12);
  EXPECT_NEAR(inRobot[5], 0.3, 1e-12);
  vpMatrix fJe;
  robot.get_fJe(fJe);
  const vpColVector outside = fJe * twist(0.1, 0.3);
  const Pose2 moved = Pose2{0.0, 0.0, 0.5} * integrate({0.1, 0.3}, 1e-6);
  EXPECT_NEAR(outside[0], moved.x / 1e-6, 1e-6);
  EXPECT_NEAR(outside[1], moved.y / 1e-6, 1e-6);
  EXPECT_NEAR(outside[5], 0.3, 1e-12);
}

TEST(BaseRobot, StopsWhenItsStateSaysSoAndWhenItIsGone)
{
  IdealBase base;
  {
    BaseRobot robot(base);
    robot.setVelocity(vpRobot::REFERENCE_FRAME, twist(0.1, 0.0));
    robot.setRobotState(vpRobot::STATE_STOP);
    EXPECT_EQ(base.told.velocity.v, 0.0);
    robot.setVelocity(vpRobot::REFERENCE_FRAME, twist(0.1, 0.0));
  }
  EXPECT_EQ(base.told.velocity.v, 0.0);
}

TEST(BaseRobot, RefusesWhatItCannotDo)
{
  IdealBase base;
  BaseRobot robot(base);
  vpColVector any;
  EXPECT_THROW(robot.setVelocity(vpRobot::CAMERA_FRAME, twist(0.1, 0.0)), vpRobotException);
  EXPECT_THROW(robot.setVelocity(vpRobot::REFERENCE_FRAME, vpColVector(6)), vpRobotException);
  EXPECT_THROW(robot.setVelocity(vpRobot::REFERENCE_FRAME,
                                 twist(std::numeric_limits<double>::quiet_NaN(), 0.0)),
               vpRobotException);
  EXPECT_THROW(robot.getPosition(vpRobot::ARTICULAR_FRAME, any), vpRobotException);
  EXPECT_THROW(robot.getDisplacement(vpRobot::ARTICULAR_FRAME, any), vpRobotException);
  EXPECT_THROW(robot.getVelocity(vpRobot::ARTICULAR_FRAME), vpRobotException);
  EXPECT_THROW(robot.setPosition(vpRobot::REFERENCE_FRAME, any), vpRobotException);
  EXPECT_EQ(base.told.velocity.v, 0.0);
}

/** A robot of ViSP that tells no position, as vpRobotPioneer. */
class SilentRobot : public BaseRobot
{
public:
  using BaseRobot::BaseRobot;
  void getPosition(const vpRobot::vpControlFrameType /*frame*/, vpColVector & /*q*/) override {}
};

TEST(VispBase, WithoutAPositionReckonsByWhatWasCommanded)
{
  IdealBase ideal;
  SilentRobot robot(ideal);
  HandClock clock;
  VispBase base(robot, clock);
  base.drive({0.1, 0.2});
  clock.sleepUntil(Time{} + fromSeconds(3.0));
  const BaseState state = base.state();
  const Pose2 expected = integrate({0.1, 0.2}, 3.0);
  EXPECT_NEAR(state.odometry.x, expected.x, 1e-9);
  EXPECT_NEAR(state.odometry.y, expected.y, 1e-9);
  EXPECT_NEAR(state.odometry.heading, 0.6, 1e-9);
  EXPECT_DOUBLE_EQ(state.velocity.v, 0.1);
}

TEST(VispBase, WithoutAPositionReckonsByWhatWasMeasured)
{
  IdealBase ideal;
  SilentRobot robot(ideal);
  HandClock clock;
  vpColVector measured = twist(0.0, 0.0);
  VispBase base(robot, clock, {vpRobot::REFERENCE_FRAME, {}, [&] { return measured; }});
  base.drive({0.1, 0.2});
  measured = twist(0.05, 0.0); // it drives slower than it was told
  base.state();
  clock.sleepUntil(Time{} + fromSeconds(3.0));
  EXPECT_NEAR(base.state().odometry.x, 0.15, 1e-9);
  EXPECT_DOUBLE_EQ(base.state().velocity.v, 0.05);
  measured = vpColVector(6);
  EXPECT_THROW(base.state(), DeviceError);
}

} // namespace
} // namespace homeward
