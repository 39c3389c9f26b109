// SPDX-License-Identifier: GPL-3.0-or-later
#include "room_space.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/evaluation/oracle_tour.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace homeward
{
namespace
{

Eigen::MatrixXd distances(const std::vector<Eigen::Vector2d> &points)
{
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd lengths(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      lengths(i, j) =
          (points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)]).norm();
    }
  }
  return lengths;
}

double lengthOf(const std::vector<int> &order, const Eigen::MatrixXd &lengths)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    sum += lengths(order[i - 1], order[i]);
  }
  return sum;
}

double shortestOf(const Eigen::MatrixXd &lengths)
{
  std::vector<int> order(static_cast<std::size_t>(lengths.rows()));
  std::iota(order.begin(), order.end(), 0);
  double best = lengthOf(order, lengths);
  while (std::next_permutation(order.begin() + 1, order.end())) {
    best = std::min(best, lengthOf(order, lengths));
  }
  return best;
}

TEST(OracleTour, anEmptyRoomIsSeenFromItsMiddle)
{
  const FreeSpace space = spaceOf(makeRoom(4.0F, 4.0F), {2.0, 2.0});
  const OracleTour tour = oracleTour(space, {2.0, 2.0}, 3.0);
  ASSERT_EQ(tour.places.size(), 1U);
  EXPECT_EQ(tour.length, 0.0);
  EXPECT_EQ(tour.coverage, 1.0);
}

TEST(OracleTour, aCorridorIsDrivenUntilItsEndIsWithinReach)
{
  constexpr double kLength = 12.0;
  constexpr double kReach = 2.0;
  const Eigen::Vector2d start(0.6, 0.7);
  const FreeSpace space = spaceOf(makeRoom(kLength, 1.4F), start);
  const OracleTour tour = oracleTour(space, start, kReach);
  EXPECT_GE(tour.coverage, 0.98);
  // The robot's middle gets to within 30 cm of the wall, and 1 % need not be seen.
  EXPECT_GT(tour.length, kLength - 0.3 - 0.15 - kReach - start.x());
  EXPECT_LT(tour.length, kLength - 0.3 - start.x());
  EXPECT_EQ(tour.places.front(), start);
  EXPECT_TRUE(std::is_sorted(tour.places.begin(), tour.places.end(),
                             [](const auto &a, const auto &b) { return a.x() < b.x(); }));
}

TEST(OracleTour, theOtherRoomIsReachedThroughTheDoor)
{
  const FreeSpace space = twoRooms();
  const Eigen::Vector2d start(1.0, 1.0);
  const OracleTour tour = oracleTour(space, start, 3.0);
  EXPECT_GE(tour.coverage, 0.98);
  const Eigen::Vector2d end = tour.places.back();
  EXPECT_GT(end.x(), 4.1) << "nobody sees through the wall";
  const Eigen::Vector2d door(4.05, 3.5);
  EXPECT_GT(tour.length, (door - start).norm());
  EXPECT_THROW(oracleTour(space, {-50.0, 0.0}, 3.0), LogicError);
}

TEST(OracleTour, anOrderIsNeverShorterThanTheBestAndSeldomMuchLonger)
{
  Random random(1, 1);
  double sum = 0.0;
  constexpr int kTimes = 50;
  for (int i = 0; i < kTimes; ++i) {
    std::vector<Eigen::Vector2d> points(7);
    for (Eigen::Vector2d &point : points) {
      point = {random.uniform(0.0, 10.0), random.uniform(0.0, 10.0)};
    }
    const Eigen::MatrixXd lengths = distances(points);
    const std::vector<int> order = shortOpenTour(lengths);
    ASSERT_EQ(order.front(), 0);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(sorted, all);
    const double ratio = lengthOf(order, lengths) / shortestOf(lengths);
    EXPECT_GE(ratio, 1.0 - 1e-9);
    sum += ratio;
  }
  EXPECT_LT(sum / kTimes, 1.05);
}

TEST(OracleTour, aLineIsDrivenFromItsEndToTheOther)
{
  const Eigen::MatrixXd lengths =
      distances({{0.0, 0.0}, {5.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}, {2.0, 0.0}});
  EXPECT_EQ(shortOpenTour(lengths), (std::vector<int>{0, 2, 4, 3, 1}));
  EXPECT_EQ(shortOpenTour(Eigen::MatrixXd::Zero(1, 1)), (std::vector<int>{0}));
}

} // namespace
} // namespace homeward
