// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/pilot/turn_witness.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace homeward
{
namespace
{

/** What a laser sees of 180 degrees in a room between x, y = 0 and 6, 4 metres. */
Scan scanAt(const Pose2 &wMl, int number, bool upsideDown)
{
  Scan scan{Time(std::chrono::milliseconds(100 * number)), -kPi / 2.0, radians(1.0), 30.0, {}};
  for (int i = 0; i <= 180; ++i) {
    const double angle = wMl.heading + scan.angle(static_cast<std::size_t>(i));
    const double x = std::cos(angle) > 0.0 ? 6.0 - wMl.x : wMl.x;
    const double y = std::sin(angle) > 0.0 ? 4.0 - wMl.y : wMl.y;
    scan.ranges.push_back(
        static_cast<float>(std::min(x / std::abs(std::cos(angle)), y / std::abs(std::sin(angle)))));
  }
  if (upsideDown) {
    std::reverse(scan.ranges.begin(), scan.ranges.end());
  }
  return scan;
}

/** Turns all the way round in steps. @return how often the witness contradicts */
int contradictions(Pose2 pose, double step, bool upsideDown)
{
  TurnWitness witness;
  int count = 0;
  for (int i = 0; i * std::abs(step) < 2.0 * kPi; ++i) {
    pose.heading = wrapAngle(pose.heading + step);
    count += witness.contradicts(scanAt(pose, i, upsideDown), pose) ? 1 : 0;
  }
  return count;
}

TEST(TurnWitness, BelievesALaserThatRunsTheRightWayRound)
{
  for (const double step : {radians(4.0), radians(-4.0), radians(25.0)}) {
    EXPECT_EQ(contradictions({1.0, 1.5, 0.3}, step, false), 0);
    EXPECT_EQ(contradictions({3.0, 2.0, 0.0}, step, false), 0); // in the middle
  }
}

TEST(TurnWitness, ContradictsOneThatIsMountedUpsideDown)
{
  for (const double step : {radians(4.0), radians(-4.0), radians(25.0)}) {
    EXPECT_GT(contradictions({1.0, 1.5, 0.3}, step, true), 0);
  }
}

TEST(TurnWitness, SaysNothingOfDrivesAndOfScansThatAreNotNew)
{
  TurnWitness witness;
  Pose2 pose{1.0, 1.5, 0.3};
  for (int i = 0; i < 20; ++i) {
    pose = pose * Pose2{0.15, 0.0, radians(12.0)};
    EXPECT_FALSE(witness.contradicts(scanAt(pose, i, true), pose));
  }
  const Scan last = scanAt(pose, 20, true);
  for (int i = 0; i < 20; ++i) {
    pose.heading += radians(4.0);
    EXPECT_FALSE(witness.contradicts(last, pose));
  }
}

TEST(SaysEnough, HalfOfTheReadings)
{
  Scan scan{{}, 0.0, 0.1, 30.0, {1.0F, 30.0F, kUnknownRange, kUnknownRange}};
  EXPECT_TRUE(saysEnough(scan));
  scan.ranges[0] = kUnknownRange;
  EXPECT_FALSE(saysEnough(scan));
}

} // namespace
} // namespace homeward
