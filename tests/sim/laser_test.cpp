// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/sim/laser_model.h>

#include <cmath>
#include <gtest/gtest.h>

namespace homeward
{
namespace
{

LaserOptions exact()
{
  LaserOptions options;
  options.sigma = 0.0;
  options.dropOutRate = 0.0;
  options.faultRate = 0.0;
  return options;
}

LaserModel laserIn(Scene scene, const LaserOptions &options, std::uint64_t seed = 1)
{
  const SolidWorld world{
      std::make_shared<RayCaster>(share(std::move(scene)), RayCaster::Layer::Collision)};
  return {world, testRobot().rMl, options, seed};
}

TEST(Laser, halfCircleHasBothEndsAndFullCircleNoTwin)
{
  const Scan half = laserIn(makeRoom(4.0F, 4.0F), exact()).measure({}, {2.0, 2.0, 0.0});
  ASSERT_EQ(half.ranges.size(), 181U);
  EXPECT_NEAR(half.angle(0), -kPi / 2.0, 1e-12);
  EXPECT_NEAR(half.angle(180), kPi / 2.0, 1e-9);
  LaserOptions full = exact();
  full.fieldOfView = 2.0 * kPi;
  EXPECT_EQ(laserIn(makeRoom(4.0F, 4.0F), full).measure({}, {2.0, 2.0, 0.0}).ranges.size(), 360U);
}

TEST(Laser, measuresFromItsOwnPlaceOnTheRobot)
{
  // Walls at x = 5 and y = 0 and 4; the laser stands 0.16 m ahead of the robot's middle.
  const Scan scan = laserIn(makeRoom(5.0F, 4.0F), exact()).measure({}, {2.0, 1.5, 0.0});
  EXPECT_NEAR(scan.ranges[90], 5.0 - 2.16, 1e-4);
  EXPECT_NEAR(scan.ranges[0], 1.5, 1e-4);
  EXPECT_NEAR(scan.ranges[180], 2.5, 1e-4);
  const Scan turned = laserIn(makeRoom(5.0F, 4.0F), exact()).measure({}, {2.0, 1.5, kPi / 2.0});
  EXPECT_NEAR(turned.ranges[90], 4.0 - 1.66, 1e-4);
  EXPECT_NEAR(turned.ranges[180], 2.0, 1e-4);
}

TEST(Laser, looksOverLowThingsAndBelowTables)
{
  Scene scene = makeRoom(5.0F, 4.0F);
  addBox(scene, {3.0F, 1.0F, 0.0F}, {3.5F, 2.0F, 0.30F});
  addBox(scene, {3.0F, 1.0F, 0.36F}, {3.5F, 2.0F, 0.40F});
  const Scan scan = laserIn(std::move(scene), exact()).measure({}, {2.0, 1.5, 0.0});
  EXPECT_NEAR(scan.ranges[90], 5.0 - 2.16, 1e-4);
}

TEST(Laser, farAndOpenReadsExactlyTheLargestRange)
{
  LaserOptions options;
  options.rangeMax = 3.0;
  options.dropOutRate = 0.0;
  options.faultRate = 0.0;
  const Scan scan = laserIn(makeRoom(20.0F, 20.0F), options).measure({}, {10.0, 10.0, 0.0});
  for (const float range : scan.ranges) {
    EXPECT_EQ(range, 3.0F);
  }
}

TEST(Laser, errorsAreOfTheSizeAndRateGiven)
{
  LaserOptions options;
  options.dropOutRate = 0.01;
  options.faultRate = 0.01;
  LaserModel laser = laserIn(makeRoom(4.0F, 4.0F), options);
  LaserModel truth = laserIn(makeRoom(4.0F, 4.0F), exact());
  const Pose2 wMr{2.0, 1.8, 0.3};
  const Scan right = truth.measure({}, wMr);
  int dropped = 0;
  int nears = 0;
  int fars = 0;
  int kept = 0;
  double squares = 0.0;
  for (int sweep = 0; sweep < 200; ++sweep) {
    const Scan scan = laser.measure({}, wMr);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const float range = scan.ranges[i];
      dropped += std::isnan(range) ? 1 : 0;
      nears += range < 0.1F ? 1 : 0;
      fars += range > 30.0F ? 1 : 0;
      if (range >= 0.1F && range <= 30.0F) {
        ++kept;
        squares += std::pow(range - right.ranges[i], 2);
      }
    }
  }
  const double readings = 200.0 * 181.0;
  EXPECT_NEAR(dropped / readings, 0.01, 0.002);
  EXPECT_NEAR(nears / readings, 0.005, 0.002);
  EXPECT_NEAR(fars / readings, 0.005, 0.002);
  EXPECT_NEAR(std::sqrt(squares / kept), 0.01, 0.0005);
}

TEST(Laser, sameSeedSameScan)
{
  const Pose2 wMr{2.0, 1.8, 0.3};
  const auto ranges = [&](std::uint64_t seed) {
    LaserOptions options;
    options.dropOutRate = 0.0;
    return laserIn(makeRoom(4.0F, 4.0F), options, seed).measure({}, wMr).ranges;
  };
  EXPECT_EQ(ranges(5), ranges(5));
  EXPECT_NE(ranges(5), ranges(6));
}

TEST(Laser, refusesOptionsThatMeanNothing)
{
  LaserOptions options;
  options.step = 0.0;
  EXPECT_THROW(laserIn(makeRoom(4.0F, 4.0F), options), LogicError);
  options = {};
  options.rangeMax = -1.0;
  EXPECT_THROW(laserIn(makeRoom(4.0F, 4.0F), options), LogicError);
}

} // namespace
} // namespace homeward
