// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/laser/half_scans.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace homeward
{
namespace
{

constexpr double kAhead = 0.16; ///< laser before the robot's centre, metres

Eigen::Isometry3d laserAhead()
{
  return Eigen::Isometry3d(Eigen::Translation3d(kAhead, 0.0, 0.33));
}

/** A rectangular room about the origin of the merged frame, with a doorway straight left. */
double rayInRoom(const Eigen::Vector2d &from, double angle, double far)
{
  constexpr double kHalfLength = 3.0;
  constexpr double kHalfWidth = 2.0;
  constexpr double kHalfDoor = 0.5;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double alongX = (std::copysign(kHalfLength, c) - from.x()) / c;
  const double alongY = (std::copysign(kHalfWidth, s) - from.y()) / s;
  if (alongX < alongY) {
    return alongX;
  }
  const bool through = s > 0.0 && std::abs(from.x() + alongY * c) < kHalfDoor;
  return through ? far : alongY;
}

/** What a half-circle laser on a robot at `mMr` sees there, `step` degrees between readings. */
PlacedScan halfScan(const Pose2 &mMr, double step, double far = 8.0)
{
  PlacedScan placed{{}, mMr};
  placed.scan.angleMin = -kPi / 2.0;
  placed.scan.angleStep = radians(step);
  placed.scan.rangeMax = 8.0;
  const Pose2 mMl = mMr * Pose2{kAhead, 0.0, 0.0};
  const auto count = static_cast<std::size_t>(180.0 / step) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = mMl.heading + placed.scan.angle(i);
    placed.scan.ranges.push_back(static_cast<float>(rayInRoom(mMl.translation(), angle, far)));
  }
  return placed;
}

/** The direction passes a jamb of the doorway so closely that laser and robot disagree on it. */
bool atJamb(double angle)
{
  const double jamb = std::atan2(2.0, 0.5);
  return std::abs(angle - jamb) < radians(6.0) || std::abs(angle - (kPi - jamb)) < radians(6.0);
}

TEST(JoinScans, OfTwoHalvesShowTheRoomFromTheMergedOrigin)
{
  for (const double step : {0.5, 1.0}) {
    const Scan joined = joinScans(
        {halfScan({}, step), halfScan({0.03, -0.02, radians(178.0)}, step)}, laserAhead());
    ASSERT_EQ(joined.ranges.size(), 360U);
    EXPECT_DOUBLE_EQ(joined.angleMin, -kPi);
    EXPECT_DOUBLE_EQ(joined.angleStep, radians(1.0));
    EXPECT_DOUBLE_EQ(joined.rangeMax, 8.0);
    for (std::size_t i = 0; i < 360; ++i) {
      const double angle = joined.angle(i);
      if (std::isnan(joined.ranges[i])) {
        // Right beside the robot lies a strip that neither half reaches.
        const bool beside = std::abs(std::abs(angle) - kPi / 2.0) < radians(10.0);
        EXPECT_TRUE(beside || atJamb(angle)) << degrees(angle);
        continue;
      }
      if (!atJamb(angle)) {
        EXPECT_NEAR(joined.ranges[i], rayInRoom({0.0, 0.0}, angle, 8.0), 0.06) << degrees(angle);
      }
    }
  }
}

TEST(JoinScans, LeaveNoHolesInsideWhatOneScanSaw)
{
  for (const double step : {0.5, 1.0}) {
    const Scan joined = joinScans({halfScan({}, step)}, laserAhead());
    const auto known = [&](int degree) {
      return !std::isnan(joined.ranges[static_cast<std::size_t>(degree + 180)]);
    };
    for (int degree = -85; degree <= 85; ++degree) {
      EXPECT_TRUE(known(degree) || atJamb(radians(degree))) << degree << " step " << step;
    }
    for (int degree = 96; degree <= 264; ++degree) {
      EXPECT_FALSE(known(degree < 180 ? degree : degree - 360)) << degree;
    }
  }
}

TEST(JoinScans, TurnWithTheRobot)
{
  const Scan straight = joinScans({halfScan({}, 1.0)}, laserAhead());
  PlacedScan turned = halfScan({}, 1.0);
  turned.mMr = {0.0, 0.0, radians(90.0)};
  const Scan left = joinScans({turned}, laserAhead());
  for (std::size_t i = 0; i < 360; ++i) {
    const float a = straight.ranges[i];
    const float b = left.ranges[(i + 90) % 360];
    EXPECT_TRUE(std::isnan(a) ? std::isnan(b) : std::abs(a - b) < 0.02F) << i;
  }
}

TEST(JoinScans, KeepTheNearestOfSeveralReadings)
{
  PlacedScan far = halfScan({}, 1.0);
  std::fill(far.scan.ranges.begin(), far.scan.ranges.end(), 4.0F);
  PlacedScan near = far;
  near.scan.ranges.assign(181, kUnknownRange);
  near.scan.ranges[90] = 1.0F;
  for (const auto &scans : {std::vector{far, near}, std::vector{near, far}}) {
    EXPECT_NEAR(joinScans(scans, laserAhead()).ranges[180], 1.0 + kAhead, 1e-6);
  }
}

TEST(JoinScans, FarReadingsAreOpenAtRangeMaxInTheirDirection)
{
  PlacedScan placed = halfScan({}, 1.0);
  placed.scan.ranges.assign(181, std::numeric_limits<float>::infinity());
  const Scan joined = joinScans({placed}, laserAhead());
  for (int degree = -90; degree <= 90; ++degree) {
    EXPECT_EQ(joined.ranges[static_cast<std::size_t>(degree + 180)], 8.0F) << degree;
  }
}

TEST(JoinScans, DropFaultsOfTheSensor)
{
  PlacedScan placed = halfScan({}, 1.0);
  placed.scan.ranges.assign(181, 0.02F);
  const Scan joined = joinScans({placed}, laserAhead());
  EXPECT_TRUE(std::all_of(joined.ranges.begin(), joined.ranges.end(),
                          [](float range) { return std::isnan(range); }));
}

TEST(JoinScans, UnderstandALaserHungUpsideDown)
{
  PlacedScan placed = halfScan({}, 1.0);
  placed.scan.ranges.assign(181, kUnknownRange);
  placed.scan.ranges[90 + 30] = 2.0F; // to its left, which is the robot's right
  Eigen::Isometry3d rMl = Eigen::Isometry3d::Identity();
  rMl.rotate(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
  const Scan joined = joinScans({placed}, rMl);
  EXPECT_NEAR(joined.ranges[180 - 30], 2.0, 1e-6);
  EXPECT_TRUE(std::isnan(joined.ranges[180 + 30]));
}

TEST(JoinScans, CarryTheLastStampAndTheLargestRange)
{
  PlacedScan a = halfScan({}, 1.0);
  PlacedScan b = a;
  a.scan.stamp = Time{fromSeconds(3.0)};
  b.scan.stamp = Time{fromSeconds(2.0)};
  b.scan.rangeMax = 16.0;
  const Scan joined = joinScans({a, b}, laserAhead());
  EXPECT_EQ(joined.stamp, a.scan.stamp);
  EXPECT_EQ(joined.rangeMax, 16.0);
}

TEST(JoinScans, RefuseNothing)
{
  EXPECT_THROW(joinScans({}, laserAhead()), LogicError);
}

} // namespace
} // namespace homeward
