// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract_room.h"
#include "device_contract.h"

namespace homeward
{
namespace
{

TEST_P(DeviceContract, thingOnTheLeftStandsAtAPositiveAngleInMetres)
{
  HOMEWARD_NEEDS_DEVICE(laser);
  wait(0.2);
  const auto scan = robot->laser()->scan();
  ASSERT_TRUE(scan);
  EXPECT_GT(scan->angleStep, 0.0);
  const Sighting post = nearestIn(*scan);
  // The post's near corner, seen from 16 cm ahead of the robot's middle.
  EXPECT_NEAR(post.bearing, std::atan2(1.8, 1.64), radians(4.0));
  EXPECT_NEAR(post.range, std::hypot(1.8, 1.64), 0.06);
}

TEST_P(DeviceContract, scanHasAWallOnEitherSideAndAhead)
{
  HOMEWARD_NEEDS_DEVICE(laser);
  wait(0.2);
  const auto scan = robot->laser()->scan();
  ASSERT_TRUE(scan);
  EXPECT_NEAR(rangeAt(*scan, 0.0), 6.0 - 0.16, 0.06);
  EXPECT_NEAR(rangeAt(*scan, radians(-90.0)), 5.0, 0.06);
  EXPECT_NEAR(rangeAt(*scan, radians(90.0)), 5.0, 0.06);
}

TEST_P(DeviceContract, scansKeepComing)
{
  HOMEWARD_NEEDS_DEVICE(laser);
  wait(0.2);
  const auto first = robot->laser()->scan();
  wait(0.5);
  const auto second = robot->laser()->scan();
  ASSERT_TRUE(first && second);
  EXPECT_GT(second->stamp, first->stamp);
  EXPECT_LE(second->stamp, robot->clock().now());
  EXPECT_EQ(second->ranges.size(), first->ranges.size());
}

} // namespace
} // namespace homeward
