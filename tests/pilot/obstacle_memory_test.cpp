// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/pilot/obstacle_memory.h>
#include <homeward/pilot/vision_worker.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** A half scan that sees one thing, at `bearing` and `range`. */
Scan scanOf(double bearing, double range, double seconds)
{
  Scan scan;
  scan.stamp = Time(fromSeconds(seconds));
  scan.angleMin = -kPi / 2;
  scan.angleStep = radians(1.0);
  scan.rangeMax = 15.0;
  scan.ranges.assign(181, 15.0F);
  const auto index =
      static_cast<std::size_t>(std::lround((bearing - scan.angleMin) / scan.angleStep));
  scan.ranges[index] = static_cast<float>(range);
  return scan;
}

TEST(ObstacleMemory, RemembersWhatStandsBehindNow)
{
  ObstacleMemory memory({});
  memory.update(scanOf(0.0, 1.0, 0.0), {}, {});
  const Pose2 turned{0.0, 0.0, kPi - 0.01};
  memory.update(scanOf(0.3, 2.0, 0.1), {}, turned);
  const auto points = memory.points(turned);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[1].x(), -1.0, 0.02);
}

TEST(ObstacleMemory, ForgetsWhatIsGone)
{
  ObstacleMemory memory({});
  memory.update(scanOf(0.0, 1.0, 0.0), {}, {});
  memory.update(scanOf(0.5, 2.0, 0.1), {}, {});
  ASSERT_EQ(memory.points({}).size(), 1U);
  EXPECT_NEAR(memory.points({})[0].norm(), 2.0, 1e-6);
}

TEST(ObstacleMemory, ForgetsWhatIsOldOrFar)
{
  ObstacleMemory memory({});
  memory.update(scanOf(0.0, 1.0, 0.0), {}, {});
  const Pose2 turned{0.0, 0.0, kPi - 0.01};
  memory.update(scanOf(0.0, 15.0, 1.0), {}, turned);
  EXPECT_EQ(memory.points(turned).size(), 1U);
  memory.update(scanOf(0.0, 15.0, 60.0), {}, turned);
  EXPECT_TRUE(memory.points(turned).empty());
}

TEST(ObstacleMemory, BelievesInContactsThatNoSensorSees)
{
  ObstacleMemory memory({});
  memory.addContact({0.5, 0.0}, Time{});
  memory.update(scanOf(0.0, 15.0, 1.0), {}, {});
  ASSERT_EQ(memory.points({}).size(), 1U);
  EXPECT_NEAR(memory.points({0.2, 0.0, 0.0})[0].x(), 0.3, 1e-9);
}

TEST(ObstacleMemory, TellsWhatItSawFromWhatContactsMadeItBelieve)
{
  ObstacleMemory memory({});
  memory.update(scanOf(0.0, 1.0, 0.0), {}, {});
  memory.addContact({0.4, 0.1}, Time(fromSeconds(0.0)));
  EXPECT_EQ(memory.points({}).size(), 2U);
  EXPECT_EQ(memory.sensed({}).size(), 1U);
  memory.forgetContacts();
  EXPECT_EQ(memory.points({}).size(), 1U);
}

TEST(ObstacleMemory, TakesNearEchoesOnly)
{
  ObstacleMemory memory({});
  memory.update({{0.0, 0.2, 0.0, 0.25}, {kPi / 2, 0.0, 0.2, 2.0}}, {}, Time{});
  ASSERT_EQ(memory.points({}).size(), 1U);
  EXPECT_NEAR(memory.points({})[0].x(), 0.45, 1e-9);
}

/** Counts a computation as done when it is told to. */
struct ToldClock final : Clock
{
  bool done = false;

  Time now() const override { return {}; }
  void sleepUntil(Time /*instant*/) override {}
  bool counts(bool /*done*/) override { return done; }
};

TEST(VisionWorker, DeliversAtTheFixedTimeAndNotBefore)
{
  ToldClock clock;
  VisionWorker<int> worker(fromSeconds(0.2));
  worker.request(Time{}, [] { return 7; });
  EXPECT_TRUE(worker.busy());
  EXPECT_FALSE(worker.deliver(Time(fromSeconds(0.19)), true, clock));
  EXPECT_EQ(worker.deliver(Time(fromSeconds(0.2)), true, clock), 7);
  EXPECT_FALSE(worker.busy());
}

TEST(VisionWorker, DeliversToWhoDoesNotWaitWhenTheClockSaysSo)
{
  ToldClock clock;
  VisionWorker<int> worker(fromSeconds(0.2));
  worker.request(Time{}, [] { return 7; });
  EXPECT_FALSE(worker.deliver(Time(fromSeconds(0.2)), false, clock));
  clock.done = true;
  EXPECT_EQ(worker.deliver(Time(fromSeconds(0.3)), false, clock), 7);
}

} // namespace
} // namespace homeward
