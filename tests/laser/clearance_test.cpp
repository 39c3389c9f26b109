// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/laser/clearance.h>

#include <gtest/gtest.h>

#include <limits>

namespace homeward
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** Longer behind than ahead and not the same left and right, so that no mix-up goes unseen. */
const Footprint kOdd{-0.4, 0.25, -0.2, 0.3};

bool covers(const Footprint &f, const Eigen::Vector2d &p)
{
  return p.x() > f.xMin && p.x() < f.xMax && p.y() > f.yMin && p.y() < f.yMax;
}

/** A point somewhere around the robot, not in it. */
Eigen::Vector2d pointOutside(Random &random)
{
  while (true) {
    const Eigen::Vector2d p(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    if (!covers(kOdd, p)) {
      return p;
    }
  }
}

/** The point as seen by a robot that has travelled along the arc. */
Eigen::Vector2d seenAfter(double travel, const Twist2 &arc, const Eigen::Vector2d &p)
{
  const double speed = arc.v != 0.0 ? std::abs(arc.v) : std::abs(arc.w);
  return integrate(arc, travel / speed).inverse() * p;
}

TEST(Clearance, IsTheDistanceToTheRectangle)
{
  EXPECT_DOUBLE_EQ(clearance({{0.75, 0.0}}, kOdd), 0.5);
  EXPECT_DOUBLE_EQ(clearance({{-0.5, 0.1}}, kOdd), 0.1);
  EXPECT_DOUBLE_EQ(clearance({{0.0, -0.5}}, kOdd), 0.3);
  EXPECT_DOUBLE_EQ(clearance({{0.25 + 0.3, 0.3 + 0.4}}, kOdd), 0.5);
  EXPECT_EQ(clearance({{0.1, 0.1}}, kOdd), 0.0);
}

TEST(Clearance, IsInfiniteWithoutPointsAndThatOfTheNearestOtherwise)
{
  EXPECT_EQ(clearance({}, kOdd), kInfinity);
  Random random(1, 0);
  std::vector<Eigen::Vector2d> points;
  double nearest = kInfinity;
  for (int i = 0; i < 50; ++i) {
    points.push_back(pointOutside(random));
    nearest = std::min(nearest, clearance({points.back()}, kOdd));
    EXPECT_EQ(clearance(points, kOdd), nearest);
  }
}

TEST(FreeTravel, StraightOnIsTheGapAhead)
{
  const std::vector<Eigen::Vector2d> points{{1.25, 0.1}, {-1.4, 0.1}, {0.6, 0.31}, {0.6, -0.21}};
  EXPECT_DOUBLE_EQ(freeTravel(points, kOdd, {0.3, 0.0}, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(freeTravel(points, kOdd, {-0.1, 0.0}, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(freeTravel(points, kOdd, {0.3, 0.0}, 0.7), 0.7);
}

TEST(FreeTravel, OfATurnIsAnAngle)
{
  // Reached by the front left corner, 0.39 m from the centre of the turn, and by nothing else.
  const double radius = std::hypot(0.25, 0.3) - 1e-9;
  const double corner = std::atan2(0.3, 0.25);
  for (const double ahead : {0.2, 0.5}) {
    const double angle = corner + ahead;
    const std::vector<Eigen::Vector2d> points{{radius * std::cos(angle), radius * std::sin(angle)}};
    EXPECT_NEAR(freeTravel(points, kOdd, {0.0, 0.7}, 6.0), ahead, 1e-4);
  }
  EXPECT_EQ(freeTravel({{0.0, 0.6}}, kOdd, {0.0, 1.0}, 6.0), 6.0) << "beyond every corner";
}

TEST(FreeTravel, EndsWhereThePointFirstMeetsTheBorder)
{
  constexpr double kStep = 0.002;
  Random random(2, 0);
  int touched = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::Vector2d p = 0.6 * pointOutside(random);
    if (covers(kOdd, p)) {
      continue;
    }
    Twist2 arc{random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0)};
    arc.v = trial % 5 == 0 ? 0.0 : arc.v;
    arc.w = trial % 7 == 1 ? 0.0 : arc.w;
    const double travel = freeTravel({p}, kOdd, arc, 3.0);
    for (double before = 0.0; before < travel; before += kStep) {
      ASSERT_FALSE(covers(kOdd.grown(-1e-9), seenAfter(before, arc, p)))
          << p.transpose() << " arc " << arc.v << " " << arc.w << " free for " << travel;
    }
    if (travel < 3.0) {
      ++touched;
      EXPECT_LT(clearance({seenAfter(travel, arc, p)}, kOdd), 1e-9);
      EXPECT_FALSE(covers(kOdd.grown(-1e-9), seenAfter(travel, arc, p)));
    }
  }
  EXPECT_GT(touched, 100);
}

TEST(FreeTravel, OfMirroredThingsIsTheSame)
{
  Random random(3, 0);
  const Footprint mirrored{kOdd.xMin, kOdd.xMax, -kOdd.yMax, -kOdd.yMin};
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Vector2d p = pointOutside(random);
    const Twist2 arc{random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0)};
    EXPECT_NEAR(freeTravel({p}, kOdd, arc, 3.0),
                freeTravel({{p.x(), -p.y()}}, mirrored, {arc.v, -arc.w}, 3.0), 1e-9);
  }
}

TEST(FreeTravel, IsContinuousInTheCurvature)
{
  const std::vector<Eigen::Vector2d> points{{1.3, 0.1}};
  const double straight = freeTravel(points, kOdd, {1.0, 0.0}, 3.0);
  for (const double curvature : {1e-3, 1e-5, 1e-6, 1e-7, 1e-12}) {
    EXPECT_NEAR(freeTravel(points, kOdd, {1.0, curvature}, 3.0), straight, 0.2 * curvature + 1e-9);
    EXPECT_NEAR(freeTravel(points, kOdd, {1.0, -curvature}, 3.0), straight, 0.2 * curvature + 1e-9);
  }
}

TEST(FreeTravel, NeverGrowsWithMorePointsOrAWiderFootprint)
{
  Random random(4, 0);
  for (int trial = 0; trial < 100; ++trial) {
    const Twist2 arc{random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0)};
    std::vector<Eigen::Vector2d> points;
    double before = 3.0;
    for (int i = 0; i < 10; ++i) {
      points.push_back(pointOutside(random));
      const double travel = freeTravel(points, kOdd, arc, 3.0);
      EXPECT_LE(travel, before + 1e-12);
      EXPECT_LE(freeTravel(points, kOdd.grown(0.05), arc, 3.0, 0.0), travel + 1e-12);
      before = travel;
    }
  }
}

TEST(FreeTravel, TakesPointsJustInsideForNoiseUnlessTheMotionGoesDeeper)
{
  const std::vector<Eigen::Vector2d> ahead{{kOdd.xMax - 0.01, 0.0}};
  EXPECT_EQ(freeTravel(ahead, kOdd, {0.5, 0.0}, 1.0), 0.0);
  EXPECT_EQ(freeTravel(ahead, kOdd, {-0.5, 0.0}, 1.0), 1.0);
  const std::vector<Eigen::Vector2d> beside{{0.1, kOdd.yMax - 0.01}};
  EXPECT_EQ(freeTravel(beside, kOdd, {0.5, 0.0}, 1.0), 1.0) << "along a wall";
  EXPECT_EQ(freeTravel(beside, kOdd, {0.0, 1.0}, 1.0), 0.0) << "its corner turns into the wall";
  const std::vector<Eigen::Vector2d> deep{{kOdd.xMax - 0.05, 0.0}};
  EXPECT_EQ(freeTravel(deep, kOdd, {-0.5, 0.0}, 1.0), 0.0) << "no noise is that deep";
}

TEST(FreeTravel, CountsANoisyPointAgainWhenItComesBack)
{
  // Just inside the right side, before the middle: a left turn leaves it behind, and the tail comes
  // round to it.
  const std::vector<Eigen::Vector2d> points{{0.05, kOdd.yMin + 0.01}};
  const double travel = freeTravel(points, kOdd, {0.0, -1.0}, 2.0 * kPi);
  EXPECT_EQ(travel, 0.0);
  const double away = freeTravel(points, kOdd, {0.0, 1.0}, 2.0 * kPi);
  EXPECT_GT(away, 0.0);
  EXPECT_LT(away, 2.0 * kPi);
}

TEST(FreeTravel, OfNoMotionIsTheHorizon)
{
  EXPECT_EQ(freeTravel({{0.3, 0.0}}, kOdd, {0.0, 0.0}, 1.5), 1.5);
}

TEST(FreeTravel, RefusesNonsense)
{
  EXPECT_THROW(freeTravel({}, {0.1, 0.1, -0.1, 0.1}, {1.0, 0.0}, 1.0), LogicError);
  EXPECT_THROW(freeTravel({}, kOdd, {1.0, 0.0}, -1.0), LogicError);
  EXPECT_THROW(clearance({}, {0.1, -0.1, -0.1, 0.1}), LogicError);
}

} // namespace
} // namespace homeward
