// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/sim/simulator.h>

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;
using testing::Not;

std::string refusal(const Scene &scene, const Pose2 &start)
{
  SimulatorOptions options;
  options.start = start;
  try {
    const Simulator simulator(share(scene), testRobot(), testCamera(), options);
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return "";
}

struct Journey
{
  Pose2 pose;
  Pose2 odometry;
  double rangeSum = 0.0;
  double sonarSum = 0.0;
};

Journey wander(std::uint64_t seed)
{
  SimulatorOptions options;
  options.seed = seed;
  Scene scene = makeRoom(8.0F, 8.0F);
  addBox(scene, {4.0F, 4.0F, 0.0F}, {4.5F, 4.5F, 1.0F});
  Simulator simulator(share(std::move(scene)), testRobot(), testCamera(), options);
  Journey journey;
  for (int tick = 0; tick < 200; ++tick) {
    simulator.base().drive({0.3, 0.4 * std::sin(0.1 * tick)});
    simulator.clock().sleepUntil(simulator.clock().now() + std::chrono::milliseconds(100));
    const auto scan = simulator.laser().scan();
    for (const float range : scan->ranges) {
      journey.rangeSum += std::isnan(range) ? 0.0F : range;
    }
    for (const SonarEcho &echo : simulator.base().state().sonar) {
      journey.sonarSum += std::isnan(echo.range) ? 0.0 : echo.range;
    }
  }
  journey.pose = simulator.truth().pose;
  journey.odometry = simulator.base().state().odometry;
  return journey;
}

TEST(Simulator, sameSeedSameRunOtherSeedOtherRun)
{
  const Journey a = wander(11);
  const Journey b = wander(11);
  const Journey c = wander(12);
  EXPECT_EQ(a.pose.x, b.pose.x);
  EXPECT_EQ(a.pose.heading, b.pose.heading);
  EXPECT_EQ(a.odometry.x, b.odometry.x);
  EXPECT_EQ(a.rangeSum, b.rangeSum);
  EXPECT_EQ(a.sonarSum, b.sonarSum);
  EXPECT_NE(a.pose.heading, c.pose.heading);
  EXPECT_NE(a.rangeSum, c.rangeSum);
}

TEST(Simulator, refusesAStartInAWallInOneLine)
{
  const std::string message = refusal(makeRoom(4.0F, 4.0F), {0.1, 2.0, 0.0});
  EXPECT_THAT(message, HasSubstr("wall"));
  EXPECT_THAT(message, HasSubstr("0.10,2.00"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

TEST(Simulator, refusesAStartOutsideTheWorld)
{
  EXPECT_THAT(refusal(makeRoom(4.0F, 4.0F), {40.0, 2.0, 0.0}), HasSubstr("outside"));
  EXPECT_THAT(refusal(makeRoom(4.0F, 4.0F), {1e300, 2.0, 0.0}), HasSubstr("outside"));
  EXPECT_THAT(refusal(makeRoom(4.0F, 4.0F), {std::nan(""), 2.0, 0.0}), HasSubstr("outside"));
}

TEST(Simulator, refusesAStartInASolidAndInACupboard)
{
  Scene scene = makeRoom(8.0F, 8.0F);
  addBox(scene, {2.0F, 2.0F, 0.0F}, {5.0F, 5.0F, 1.5F});
  EXPECT_THAT(refusal(scene, {3.5, 3.5, 0.0}), HasSubstr("wall"));
  EXPECT_THAT(refusal(makeRoom(1.0F, 1.0F), {0.5, 0.5, 0.0}), HasSubstr("1 m^2"));
}

TEST(Simulator, refusesAWorldWithNothingInIt)
{
  EXPECT_THAT(refusal(Scene{}, {}), HasSubstr("nothing stands"));
}

TEST(Simulator, kidnappedRobotIsElsewhereAndItsOdometryDoesNotKnow)
{
  SimulatorOptions options;
  options.start = Pose2{2.0, 2.0, 0.0};
  Simulator simulator(share(makeRoom(8.0F, 8.0F)), testRobot(), testCamera(), options);
  const float before = simulator.laser().scan()->ranges[90];
  const Pose2 odometry = simulator.base().state().odometry;
  simulator.kidnap({5.0, 5.0, 1.0});
  EXPECT_EQ(simulator.truth().pose.x, 5.0);
  EXPECT_EQ(simulator.base().state().odometry.x, odometry.x);
  EXPECT_GT(std::abs(simulator.laser().scan()->ranges[90] - before), 0.5F);
  EXPECT_THROW(simulator.kidnap({0.0, 5.0, 1.0}), ConfigError);
  EXPECT_EQ(simulator.truth().pose.x, 5.0);
}

TEST(Simulator, sensorsAskedTwiceInOneInstantSayTheSame)
{
  Simulator simulator(share(makeRoom(4.0F, 4.0F)), testRobot(), testCamera());
  const auto first = simulator.laser().scan();
  const auto second = simulator.laser().scan();
  for (std::size_t i = 0; i < first->ranges.size(); ++i) {
    EXPECT_TRUE(first->ranges[i] == second->ranges[i] ||
                (std::isnan(first->ranges[i]) && std::isnan(second->ranges[i])));
  }
  const auto sonar = simulator.base().state().sonar;
  EXPECT_EQ(sonar.at(3).range, simulator.base().state().sonar.at(3).range);
}

} // namespace
} // namespace homeward
