// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/random.h>
#include <homeward/viewer/map_layout.h>

#include <gtest/gtest.h>

#include <cmath>

namespace homeward
{
namespace
{

double distance(const Pose2 &a, const Pose2 &b)
{
  return (a.translation() - b.translation()).norm();
}

double bearingTo(const Pose2 &from, const Pose2 &to)
{
  const Eigen::Vector2d way = to.translation() - from.translation();
  return wrapAngle(std::atan2(way.y(), way.x()) - from.heading);
}

/** A map of places at true poses, joined as told, with true bearings. */
TopologicalMap mapAt(const std::vector<Pose2> &poses, const std::vector<std::pair<int, int>> &edges)
{
  TopologicalMap map;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    map.apply(NodeAdded{{{static_cast<std::int64_t>(i)}, {}}});
  }
  for (const auto &[a, b] : edges) {
    const Pose2 &poseA = poses[static_cast<std::size_t>(a)];
    const Pose2 &poseB = poses[static_cast<std::size_t>(b)];
    map.apply(
        EdgeAdded{{map.nextEdgeId(), {a}, {b}, bearingTo(poseA, poseB), bearingTo(poseB, poseA)}});
  }
  return map;
}

/**
 * A ring of places with random headings, and a spur from place 0 to tell where it is. With side -1,
 * its mirror image, which has the same edges.
 *
 *      2 - 1
 *     /     \.
 *    3       0 - 6
 *     \     /
 *      4 - 5
 */
TopologicalMap ring(std::uint64_t seed, double side)
{
  Random random(seed, 0);
  std::vector<Pose2> poses;
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i < 6; ++i) {
    poses.push_back(
        {std::cos(kPi / 3.0 * i), side * std::sin(kPi / 3.0 * i), random.uniform(-kPi, kPi)});
    edges.emplace_back(i, (i + 1) % 6);
  }
  poses.push_back({2.0, 0.0, 0.3});
  edges.emplace_back(0, 6);
  return mapAt(poses, edges);
}

TEST(MapLayout, AChainIsStraightAndOneUnitAnEdge)
{
  const std::vector<Pose2> poses(5);
  const auto places = layOut(mapAt(poses, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  ASSERT_EQ(places.size(), 5U);
  for (std::int64_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(distance(places.at({0}), places.at({i})), static_cast<double>(i), 0.05);
  }
}

TEST(MapLayout, HeadingsAndHandednessFitTheBearings)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TopologicalMap map = ring(seed, seed % 2 == 0 ? 1.0 : -1.0);
    const auto places = layOut(map);
    for (const auto &[id, edge] : map.edges()) {
      const double found = bearingTo(places.at(edge.a), places.at(edge.b));
      ASSERT_LT(std::abs(wrapAngle(found - *edge.bearingAtA)), 0.35) << "seed " << seed;
    }
  }
}

TEST(MapLayout, IsTheSameEveryTime)
{
  const auto first = layOut(ring(1, 1.0));
  const auto second = layOut(ring(1, 1.0));
  for (const auto &[id, pose] : first) {
    EXPECT_EQ(pose.x, second.at(id).x);
    EXPECT_EQ(pose.y, second.at(id).y);
    EXPECT_EQ(pose.heading, second.at(id).heading);
  }
}

TEST(MapLayout, PartsThatAreNotJoinedStandApart)
{
  const auto places = layOut(mapAt(std::vector<Pose2>(4), {{0, 1}, {2, 3}}));
  for (const std::int64_t a : {0, 1}) {
    for (const std::int64_t b : {2, 3}) {
      EXPECT_GT(distance(places.at({a}), places.at({b})), 1.0);
    }
  }
}

TEST(MapLayout, OfNothingIsNothingAndOfOnePlaceIsFinite)
{
  EXPECT_TRUE(layOut(TopologicalMap()).empty());
  const auto places = layOut(mapAt({Pose2()}, {}));
  EXPECT_TRUE(std::isfinite(places.at({0}).x));
  EXPECT_EQ(places.at({0}).heading, 0.0);
}

} // namespace
} // namespace homeward
