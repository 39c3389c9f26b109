// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/topology/reckoning.h>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace homeward
{
namespace
{

//  Places on a floor, in random headings, and ways between them as a robot notes them.
struct Floor
{
  TopologicalMap map;
  std::vector<Pose2> places;
  Random random{1, 0};

  void add(double x, double y)
  {
    places.push_back({x, y, random.uniform(-kPi, kPi)});
    map.apply(NodeAdded{{map.nextNodeId(), {}}});
  }

  /** @param error metres, one sigma, of each coordinate of the way as noted; a third in radians */
  void join(std::size_t a, std::size_t b, double error = 0.0)
  {
    Pose2 way = places[a].inverse() * places[b];
    way.x += random.normal(error);
    way.y += random.normal(error);
    way.heading += random.normal(error / 3.0);
    note(a, b, way);
  }

  void note(std::size_t a, std::size_t b, const Pose2 &aMb)
  {
    const Pose2 bMa = aMb.inverse();
    map.apply(EdgeAdded{{map.nextEdgeId(), NodeId{static_cast<std::int64_t>(a)},
                         NodeId{static_cast<std::int64_t>(b)}, std::atan2(aMb.y, aMb.x),
                         std::atan2(bMa.y, bMa.x), std::hypot(aMb.x, aMb.y)}});
  }

  /** Metres that `b` is reckoned off, seen from `a`. */
  double error(std::size_t a, std::size_t b) const
  {
    const Reckoning reckoning(map, NodeId{static_cast<std::int64_t>(a)});
    const Pose2 truth = places[a].inverse() * places[b];
    const Pose2 found = reckoning.find(NodeId{static_cast<std::int64_t>(b)})->fromMto;
    return (found.translation() - truth.translation()).norm();
  }

  double sigma(std::size_t a, std::size_t b) const
  {
    const Reckoning reckoning(map, NodeId{static_cast<std::int64_t>(a)});
    return reckoning.find(NodeId{static_cast<std::int64_t>(b)})->sigma;
  }
};

//  0 - 1 - ... - 9, two metres apart.
Floor corridor(double error)
{
  Floor floor;
  for (int i = 0; i < 10; ++i) {
    floor.add(2.0 * i, 0.0);
  }
  for (std::size_t i = 1; i < 10; ++i) {
    floor.join(i - 1, i, error);
  }
  return floor;
}

TEST(Reckoning, ChainsWaysThatAreExact)
{
  const Floor floor = corridor(0.0);
  EXPECT_LT(floor.error(0, 9), 1e-9);
  EXPECT_LT(floor.error(6, 2), 1e-9);
  EXPECT_LT(floor.error(4, 4), 1e-12);
  EXPECT_EQ(floor.sigma(4, 4), 0.0);
}

TEST(Reckoning, FindsWhoStandsNearAPoint)
{
  Floor floor = corridor(0.0);
  floor.add(12.0, 0.5); // beside 6, but no way leads there
  const Pose2 oMfour = floor.places[4];
  const auto near = [&](double x, double y, double metres) {
    return Reckoning(floor.map, NodeId{4}).near(oMfour.inverse() * Eigen::Vector2d(x, y), metres);
  };
  const std::vector<NodeId> both{NodeId{5}, NodeId{6}};
  EXPECT_EQ(near(10.9, 0.1, 1.2), both);
  EXPECT_EQ(near(8.0, 0.0, 0.1), std::vector{NodeId{4}});
  EXPECT_TRUE(near(8.0, 1.0, 0.9).empty());
}

TEST(Reckoning, KnowsLessOfPlacesFartherOff)
{
  const Floor floor = corridor(0.1);
  EXPECT_GT(floor.sigma(0, 1), 0.05);
  EXPECT_GT(floor.sigma(0, 4), 1.5 * floor.sigma(0, 1));
  EXPECT_GT(floor.sigma(0, 9), 2.0 * floor.sigma(0, 4));
}

TEST(Reckoning, WeighsAllWaysTogether)
{
  Floor ladder; // two rows of ten, every place joined with those beside and across
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < 10; ++i) {
      ladder.add(2.0 * i, 2.0 * row);
    }
  }
  for (std::size_t i = 0; i < 10; ++i) {
    ladder.join(i, 10 + i, 0.1);
    for (const std::size_t row : {0U, 10U}) {
      if (i > 0) {
        ladder.join(row + i - 1, row + i, 0.1);
      }
    }
  }
  EXPECT_LT(ladder.sigma(0, 9), 0.8 * corridor(0.1).sigma(0, 9));
  EXPECT_LT(ladder.error(0, 9), 3.0 * ladder.sigma(0, 9));
}

TEST(Reckoning, OneWrongWayBendsLittle)
{
  Floor ring; // twelve places round a table, and a way across that leads somewhere else
  for (int i = 0; i < 12; ++i) {
    const double angle = radians(30.0 * i);
    ring.add(4.0 * std::cos(angle), 4.0 * std::sin(angle));
  }
  for (std::size_t i = 0; i < 12; ++i) {
    ring.join(i, (i + 1) % 12);
    ring.join(i, (i + 2) % 12);
  }
  ring.note(0, 6, {2.0, 0.0, 0.0});
  EXPECT_LT(ring.error(0, 6), 1.0); // the way says 6 m off
  EXPECT_LT(ring.error(3, 9), 1.0);
}

TEST(Reckoning, SaysNothingOfPlacesCutOff)
{
  Floor floor = corridor(0.0);
  floor.add(0.0, 5.0);
  floor.map.apply(EdgeAdded{{floor.map.nextEdgeId(), NodeId{9}, NodeId{10}, 0.3, {}, 1.0}});
  const Reckoning reckoning(floor.map, NodeId{0});
  EXPECT_FALSE(reckoning.find(NodeId{10})); // its way lacks a bearing
  EXPECT_FALSE(reckoning.find(NodeId{77}));
  EXPECT_TRUE(Reckoning(floor.map, NodeId{10}).find(NodeId{10}));
  EXPECT_THROW(Reckoning(floor.map, NodeId{77}), LogicError);
}

} // namespace
} // namespace homeward
