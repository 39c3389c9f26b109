// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/laser/open_directions.h>

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <utility>

namespace homeward
{
namespace
{

using ::testing::HasSubstr;

/** 360 readings, one a degree from -180, at 2 m, with others in the ranges of degrees given. */
class Around
{
public:
  explicit Around(float wall = 2.0F, double rangeMax = 30.0)
  {
    m_scan.angleMin = -kPi;
    m_scan.angleStep = radians(1.0);
    m_scan.rangeMax = rangeMax;
    m_scan.ranges.assign(360, wall);
  }

  /** Degrees first to last, both included, counted on beyond 180. */
  Around &with(int first, int last, float range)
  {
    for (int degree = first; degree <= last; ++degree) {
      m_scan.ranges[static_cast<std::size_t>((degree + 180) % 360)] = range;
    }
    return *this;
  }

  operator const Scan &() const { return m_scan; }

private:
  Scan m_scan;
};

std::vector<OpenDirection> find(const Scan &scan, const OpenDirectionOptions &options = {})
{
  return findOpenDirections(scan, options);
}

/** The one direction found, in degrees: bearing and width. */
void expectOne(const Scan &scan, double bearing, double width,
               const OpenDirectionOptions &options = {})
{
  const auto found = find(scan, options);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(degrees(wrapAngle(found[0].bearing - radians(bearing))), 0.0, 1e-9)
      << degrees(found[0].bearing);
  EXPECT_NEAR(degrees(found[0].width), width, 1e-9);
}

TEST(OpenDirections, PointsAtTheMiddleOfASegment)
{
  expectOne(Around().with(10, 40, 6.0F), 25.0, 30.0);
  EXPECT_FLOAT_EQ(static_cast<float>(find(Around().with(10, 40, 6.0F))[0].range), 6.0F);
}

TEST(OpenDirections, TurnWithTheScan)
{
  for (int turn = -180; turn < 180; turn += 7) {
    const auto found = find(Around().with(turn + 180 + 20, turn + 180 + 60, 6.0F));
    ASSERT_EQ(found.size(), 1U) << turn;
    EXPECT_NEAR(wrapAngle(found[0].bearing - radians(turn + 180 + 40)), 0.0, 1e-9) << turn;
    EXPECT_NEAR(degrees(found[0].width), 40.0, 1e-9) << turn;
  }
}

TEST(OpenDirections, OpenIsAShareOfTheLargestKeptRange)
{
  // 10 m is the largest; 6 m is open, 5.9 m is not.
  const auto found = find(Around().with(-120, -90, 10.0F).with(0, 30, 6.0F).with(90, 120, 5.9F));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(degrees(found[0].bearing), -105.0, 1e-9);
  EXPECT_NEAR(degrees(found[1].bearing), 15.0, 1e-9);
}

TEST(OpenDirections, DropsFaultsNearAndFar)
{
  OpenDirectionOptions options;
  options.farBound = 15.0;
  // Faults do not raise the largest range; a near one hides nothing.
  expectOne(Around().with(10, 40, 6.0F).with(100, 120, 16.0F).with(150, 160, 0.05F), 25.0, 30.0,
            options);
}

TEST(OpenDirections, AReadingAtMaximumIsFarAndOpen)
{
  OpenDirectionOptions bounded;
  bounded.farBound = 15.0;
  expectOne(Around(2.0F, 30.0).with(10, 40, 30.0F), 25.0, 30.0, bounded);
  EXPECT_EQ(find(Around(2.0F, 30.0).with(10, 40, 30.0F), bounded)[0].range, 15.0);
  // It counts as the bound, so that a wall at 12 m stays open beside it.
  EXPECT_EQ(find(Around(2.0F, 30.0).with(10, 40, 30.0F).with(90, 130, 12.0F), bounded).size(), 2U);
  expectOne(Around(2.0F, 8.0).with(10, 40, std::numeric_limits<float>::infinity()), 25.0, 30.0);
  EXPECT_EQ(find(Around(2.0F, 8.0).with(10, 40, 7.7F))[0].range, 8.0);
}

TEST(OpenDirections, BridgesDroppedReadingsUpToTwoDegrees)
{
  expectOne(Around().with(10, 50, 6.0F).with(25, 26, kUnknownRange), 30.0, 40.0);
  expectOne(Around().with(10, 50, 6.0F).with(25, 26, 0.02F), 30.0, 40.0);
  const auto found = find(Around().with(5, 60, 6.0F).with(25, 27, kUnknownRange));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(degrees(found[0].width), 32.0, 1e-9);
  EXPECT_NEAR(degrees(found[1].width), 19.0, 1e-9);
}

TEST(OpenDirections, AnEndOfDroppedReadingsBelongsToNoSegment)
{
  expectOne(Around().with(10, 40, 6.0F).with(41, 42, kUnknownRange), 25.0, 30.0);
}

TEST(OpenDirections, JoinAcrossTheBackWhereItWasSeen)
{
  expectOne(Around().with(160, 200, 6.0F), 180.0, 40.0);
  expectOne(Around().with(150, 200, 6.0F).with(180, 181, kUnknownRange), 175.0, 50.0);
  const auto unseen = find(Around().with(140, 220, 6.0F).with(179, 182, kUnknownRange));
  ASSERT_EQ(unseen.size(), 2U);
  EXPECT_NEAR(degrees(unseen[0].width), 38.0, 1e-9);
}

TEST(OpenDirections, OfAHalfScanDoNotJoinItsEnds)
{
  Scan half;
  half.angleMin = -kPi / 2.0;
  half.angleStep = radians(1.0);
  half.rangeMax = 30.0;
  half.ranges.assign(181, 2.0F);
  for (std::size_t i = 0; i < 30; ++i) {
    half.ranges[i] = 6.0F;
    half.ranges[180 - i] = 6.0F;
  }
  const auto found = find(half);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(degrees(found[0].bearing), -75.5, 1e-9);
  EXPECT_NEAR(degrees(found[1].bearing), 75.5, 1e-9);
}

TEST(OpenDirections, CountTheRepeatedReadingOfAClosedScanOnce)
{
  Scan scan = Around().with(160, 200, 6.0F);
  scan.ranges.push_back(scan.ranges.front());
  expectOne(scan, 180.0, 40.0);
}

TEST(OpenDirections, DropWhatTheRobotCannotEnter)
{
  OpenDirectionOptions options;
  options.stoppingRange = 1.5;
  options.footprintWidth = 0.49;
  // 0.49 m at 1.5 m are 18.8 degrees.
  EXPECT_TRUE(find(Around().with(10, 28, 6.0F), options).empty());
  EXPECT_EQ(find(Around().with(10, 29, 6.0F), options).size(), 1U);
  options.stoppingRange = 3.0;
  EXPECT_EQ(find(Around().with(10, 20, 6.0F), options).size(), 1U);
}

TEST(OpenDirections, AreSortedByWidthAndTheBestKept)
{
  const Around scan = Around()
                          .with(-170, -150, 6.0F)
                          .with(-100, -60, 6.0F)
                          .with(-20, 10, 6.0F)
                          .with(50, 100, 6.0F)
                          .with(130, 155, 6.0F);
  const auto found = find(scan);
  ASSERT_EQ(found.size(), 4U);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GE(found[i - 1].width, found[i].width);
  }
  EXPECT_NEAR(degrees(found[0].bearing), 75.0, 1e-9);
  OpenDirectionOptions options;
  options.count = 5;
  EXPECT_EQ(find(scan, options).size(), 5U);
  options.count = 1;
  expectOne(scan, 75.0, 50.0, options);
}

TEST(OpenDirections, ACapKeepsNearerWaysOpenInLargePlaces)
{
  const Around hall = Around().with(10, 40, 25.0F).with(90, 130, 6.0F);
  EXPECT_EQ(find(hall).size(), 1U);
  OpenDirectionOptions options;
  options.openRangeCap = 5.0;
  EXPECT_EQ(find(hall, options).size(), 2U);
  options.openRangeCap = 100.0;
  EXPECT_EQ(find(hall, options).size(), 1U);
}

TEST(OpenDirections, AWideSegmentIsSplitIntoEqualParts)
{
  OpenDirectionOptions options;
  options.widestSegment = radians(45.0);
  options.count = 10;
  const auto found = find(Around().with(-60, 60, 6.0F), options);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(degrees(found[i].width), 40.0, 1e-9);
  }
  EXPECT_NEAR(degrees(found[0].bearing), -40.0, 1e-9);
  EXPECT_NEAR(degrees(found[1].bearing), 0.0, 1e-9);
  EXPECT_NEAR(degrees(found[2].bearing), 40.0, 1e-9);
  expectOne(Around().with(-60, -15, 6.0F), -37.5, 45.0, options);
}

TEST(OpenDirections, AllRoundIsOneDirectionOrItsParts)
{
  EXPECT_EQ(find(Around(6.0F)).size(), 1U);
  OpenDirectionOptions options;
  options.widestSegment = radians(90.0);
  EXPECT_EQ(find(Around(6.0F), options).size(), 4U);
}

TEST(OpenDirections, OfNothingSeenAreNone)
{
  EXPECT_TRUE(find(Around(kUnknownRange)).empty());
  Scan empty = Around();
  empty.ranges.clear();
  EXPECT_TRUE(find(empty).empty());
}

TEST(OpenDirections, RefuseBadOptionsByName)
{
  const auto refused = [](const std::function<void(OpenDirectionOptions &)> &change,
                          const char *name) {
    OpenDirectionOptions options;
    change(options);
    try {
      findOpenDirections(Around(), options);
      ADD_FAILURE() << name << " accepted";
    }
    catch (const LogicError &error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto &o) { o.nearBound = -0.1; }, "nearBound");
  refused([](auto &o) { o.farBound = 0.05; }, "farBound");
  refused([](auto &o) { o.openShare = 0.0; }, "openShare");
  refused([](auto &o) { o.openShare = 1.1; }, "openShare");
  refused([&](auto &o) { o.bridgedGap = nan; }, "bridgedGap");
  refused([](auto &o) { o.footprintWidth = -1.0; }, "footprintWidth");
  refused([](auto &o) { o.stoppingRange = 0.0; }, "stoppingRange");
  refused([](auto &o) { o.count = 0; }, "count");
  refused([](auto &o) { o.openRangeCap = -1.0; }, "openRangeCap");
  refused([&](auto &o) { o.widestSegment = nan; }, "widestSegment");
}

TEST(OpenDirections, RefuseABadScan)
{
  Scan scan = Around();
  scan.ranges.resize(400, 2.0F);
  EXPECT_THROW(find(scan), LogicError);
  scan = Around();
  scan.angleStep = 0.0;
  EXPECT_THROW(find(scan), LogicError);
  scan = Around();
  scan.rangeMax = 0.0;
  EXPECT_THROW(find(scan), LogicError);
}

} // namespace
} // namespace homeward
