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

/** A room of 6 m x 4 m, the robot in it at (1, 2) looking along x. */
std::unique_ptr<Simulator> inRoom(const Scene &scene)
{
  SimulatorOptions options;
  options.start = Pose2{1.0, 2.0, 0.0};
  options.laser.sigma = 0.0;
  options.laser.dropOutRate = 0.0;
  options.laser.faultRate = 0.0;
  return std::make_unique<Simulator>(share(scene), testRobot(), testCamera(), options);
}

/** A box of 1.8 m height, 2 m ahead of that robot. */
Scene withBox(Scene scene)
{
  addBox(scene, {3.0F, 1.0F, 0.0F}, {3.5F, 3.0F, 1.8F}, {0.9F, 0.0F, 0.0F});
  return scene;
}

float ahead(Simulator &simulator)
{
  return simulator.laser().scan()->ranges[90];
}

/** Drives for 8 s at 0.4 m/s. */
void driveOn(Simulator &simulator)
{
  for (int tick = 0; tick < 80; ++tick) {
    simulator.base().drive({0.4, 0.0});
    simulator.clock().sleepUntil(simulator.clock().now() + std::chrono::milliseconds(100));
  }
}

struct Journey
{
  Pose2 pose;
  Pose2 odometry;
  double rangeSum = 0.0;
  double sonarSum = 0.0;
};

/** @param before called before each tick */
Journey wander(std::uint64_t seed, const std::function<void(Simulator &)> &before = {})
{
  SimulatorOptions options;
  options.seed = seed;
  Scene scene = makeRoom(8.0F, 8.0F);
  addBox(scene, {4.0F, 4.0F, 0.0F}, {4.5F, 4.5F, 1.0F});
  Simulator simulator(share(std::move(scene)), testRobot(), testCamera(), options);
  Journey journey;
  for (int tick = 0; tick < 200; ++tick) {
    if (before) {
      before(simulator);
    }
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

TEST(Simulator, everySensorAndTheBodyMeetWhatIsPutThere)
{
  const auto simulator = inRoom(makeRoom(6.0F, 4.0F));
  const float wall = ahead(*simulator);
  const cv::Mat before = simulator->camera().grab()->image;
  const double echo = simulator->base().state().sonar.at(3).range;
  const double area = simulator->freeSpace().area();

  Scene things;
  things = withBox(std::move(things));
  simulator->put(share(things));
  EXPECT_NEAR(wall - ahead(*simulator), 3.0F, 0.02F);
  EXPECT_LT(simulator->base().state().sonar.at(3).range, echo - 1.0);
  EXPECT_GT(cv::norm(simulator->camera().grab()->image, before, cv::NORM_INF), 50.0);
  EXPECT_EQ(simulator->freeSpace().area(), area);
  EXPECT_THROW(simulator->kidnap({3.2, 2.0, 0.0}), ConfigError);
  driveOn(*simulator);
  EXPECT_TRUE(simulator->base().state().stalled);
  EXPECT_EQ(simulator->truth().collisions, 1);
  EXPECT_NEAR(simulator->truth().pose.x, 2.75, 0.03);

  simulator->put(nullptr);
  EXPECT_GT(ahead(*simulator), 2.0F);
  driveOn(*simulator);
  EXPECT_GT(simulator->truth().pose.x, 5.0);
}

TEST(Simulator, aChangedWorldIsTheWorldFromThenOn)
{
  const Scene empty = makeRoom(6.0F, 4.0F);
  const auto simulator = inRoom(empty);
  const float wall = ahead(*simulator);
  const cv::Mat before = simulator->camera().grab()->image;
  const Pose2 odometry = simulator->base().state().odometry;
  const double area = simulator->freeSpace().area();

  simulator->change(share(withBox(empty)));
  EXPECT_NEAR(wall - ahead(*simulator), 3.0F, 0.02F);
  EXPECT_GT(cv::norm(simulator->camera().grab()->image, before, cv::NORM_INF), 50.0);
  EXPECT_EQ(simulator->base().state().odometry.x, odometry.x);
  EXPECT_EQ(simulator->freeSpace().area(), area);
  driveOn(*simulator);
  EXPECT_NEAR(simulator->truth().pose.x, 2.75, 0.03);

  simulator->change(share(empty));
  driveOn(*simulator);
  EXPECT_GT(simulator->truth().pose.x, 5.0);
}

TEST(Simulator, nothingIsPutOntoTheRobot)
{
  const Scene empty = makeRoom(6.0F, 4.0F);
  const auto simulator = inRoom(empty);
  const float wall = ahead(*simulator);
  Scene onIt = empty;
  addBox(onIt, {1.0F, 1.8F, 0.0F}, {1.4F, 2.2F, 1.0F});
  EXPECT_THROW(simulator->change(share(onIt)), ConfigError);
  EXPECT_THROW(simulator->put(share(onIt)), ConfigError);
  EXPECT_EQ(ahead(*simulator), wall);
  driveOn(*simulator);
  EXPECT_GT(simulator->truth().pose.x, 3.0);
}

TEST(Simulator, aChangeToTheSameChangesNothing)
{
  Scene scene = makeRoom(8.0F, 8.0F);
  addBox(scene, {4.0F, 4.0F, 0.0F}, {4.5F, 4.5F, 1.0F});
  const auto same = share(std::move(scene));
  int calls = 0;
  const Journey quiet = wander(11);
  const Journey busy = wander(11, [&](Simulator &simulator) {
    simulator.put(share(Scene()));
    if (++calls % 50 == 0) {
      simulator.change(same);
    }
  });
  EXPECT_EQ(quiet.pose.x, busy.pose.x);
  EXPECT_EQ(quiet.odometry.x, busy.odometry.x);
  EXPECT_EQ(quiet.rangeSum, busy.rangeSum);
  EXPECT_EQ(quiet.sonarSum, busy.sonarSum);
}

TEST(Simulator, saysWhenAStepOfTheWorldBegins)
{
  const auto simulator = inRoom(makeRoom(6.0F, 4.0F));
  std::vector<Time> steps;
  simulator->onStep = [&](Time now) { steps.push_back(now); };
  simulator->clock().sleepUntil(Time{} + 3 * Simulator::kStep);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps.back(), Time{} + 2 * Simulator::kStep);
}

} // namespace
} // namespace homeward
