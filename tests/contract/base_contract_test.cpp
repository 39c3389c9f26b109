// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract_room.h"
#include "device_contract.h"

namespace homeward
{
namespace
{

TEST_P(DeviceContract, forwardIsMetresASecondAlongX)
{
  HOMEWARD_NEEDS_DEVICE(base);
  const Pose2 before = robot->base()->state().odometry;
  drive({0.3, 0.0}, 4.0);
  EXPECT_NEAR(robot->base()->state().velocity.v, 0.3, 0.03);
  driveAndStop({0.0, 0.0}, 0.1);
  const Pose2 moved = before.inverse() * robot->base()->state().odometry;
  // 0.3 m/s for 4 s, less what the ramps cost or add.
  EXPECT_NEAR(moved.x, 1.2, 0.25);
  EXPECT_NEAR(moved.y, 0.0, 0.1);
  EXPECT_NEAR(moved.heading, 0.0, radians(3.0));
}

TEST_P(DeviceContract, backwardIsNegative)
{
  HOMEWARD_NEEDS_DEVICE(base);
  const Pose2 before = robot->base()->state().odometry;
  driveAndStop({-0.2, 0.0}, 3.0);
  EXPECT_NEAR((before.inverse() * robot->base()->state().odometry).x, -0.6, 0.2);
}

TEST_P(DeviceContract, positiveTurnIsCounterClockwiseInRadiansASecond)
{
  HOMEWARD_NEEDS_DEVICE(base);
  const Pose2 before = robot->base()->state().odometry;
  drive({0.0, 0.4}, 2.0);
  EXPECT_NEAR(robot->base()->state().velocity.w, 0.4, 0.04);
  driveAndStop({0.0, 0.0}, 0.1);
  const Pose2 moved = before.inverse() * robot->base()->state().odometry;
  EXPECT_NEAR(moved.heading, 0.8, 0.16);
  EXPECT_NEAR(moved.translation().norm(), 0.0, 0.05);
}

TEST_P(DeviceContract, odometryAdvancesAsTheLaserSeesTheWallComeNearer)
{
  HOMEWARD_NEEDS_DEVICE(base);
  HOMEWARD_NEEDS_DEVICE(laser);
  const Pose2 before = robot->base()->state().odometry;
  const double wallBefore = rangeAt(*robot->laser()->scan(), 0.0);
  driveAndStop({0.3, 0.0}, 5.0);
  const Pose2 moved = before.inverse() * robot->base()->state().odometry;
  const double wallAfter = rangeAt(*robot->laser()->scan(), 0.0);
  EXPECT_GT(moved.x, 1.0);
  EXPECT_NEAR(wallBefore - wallAfter, moved.x, 0.05 + 0.05 * moved.x);
}

TEST_P(DeviceContract, odometryTurnsAsTheLaserSeesThePostTurnTheOtherWay)
{
  HOMEWARD_NEEDS_DEVICE(base);
  HOMEWARD_NEEDS_DEVICE(laser);
  const Pose2 before = robot->base()->state().odometry;
  const Sighting postBefore = nearestIn(*robot->laser()->scan());
  driveAndStop({0.0, 0.4}, 2.0);
  const Pose2 moved = before.inverse() * robot->base()->state().odometry;
  const Sighting postAfter = nearestIn(*robot->laser()->scan());
  EXPECT_GT(moved.heading, radians(30.0));
  // The laser stands off the axis of the turn, and the nearest corner may change.
  EXPECT_NEAR(postBefore.bearing - postAfter.bearing, moved.heading, radians(10.0));
}

TEST_P(DeviceContract, zeroStopsAndItStaysWhereItStopped)
{
  HOMEWARD_NEEDS_DEVICE(base);
  drive({0.3, 0.2}, 2.0);
  drive({}, 2.0);
  const BaseState stopped = robot->base()->state();
  EXPECT_NEAR(stopped.velocity.v, 0.0, 1e-3);
  EXPECT_NEAR(stopped.velocity.w, 0.0, 1e-3);
  wait(1.0);
  const BaseState later = robot->base()->state();
  EXPECT_NEAR((stopped.odometry.translation() - later.odometry.translation()).norm(), 0.0, 2e-3);
  EXPECT_FALSE(later.stalled);
}

TEST_P(DeviceContract, watchdogStopsABaseThatNobodyCommands)
{
  HOMEWARD_NEEDS_DEVICE(base);
  drive({0.3, 0.0}, 2.0);
  wait(2.5);
  EXPECT_NEAR(robot->base()->state().velocity.v, 0.0, 1e-3);
}

TEST_P(DeviceContract, stateIsStampedWithAPastThatMovesOn)
{
  HOMEWARD_NEEDS_DEVICE(base);
  const BaseState first = robot->base()->state();
  wait(0.5);
  const BaseState second = robot->base()->state();
  EXPECT_GT(second.stamp, first.stamp);
  EXPECT_LE(second.stamp, robot->clock().now());
}

} // namespace
} // namespace homeward
