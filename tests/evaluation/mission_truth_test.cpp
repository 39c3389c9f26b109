// SPDX-License-Identifier: GPL-3.0-or-later
#include "room_space.h"

#include <homeward/evaluation/mission_truth.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

using Edges = std::vector<std::pair<NodeId, NodeId>>;

constexpr double kForward = 2.0; // metres
const Eigen::Vector2d kStart(1.0, 1.0);

TEST(MissionTruth, aNodeInTheMiddleOfEachRoomCoversBoth)
{
  const FreeSpace space = twoRooms();
  EXPECT_EQ(judgeMission(space, kStart, {}, Edges{}, kForward).coverage, 0.0);
  const double half =
      judgeMission(space, kStart, {{NodeId{0}, {2.0, 2.0, 0.0}}}, Edges{}, kForward).coverage;
  EXPECT_NEAR(half, 0.5, 0.06) << "a node sees only its own room";
  const std::map<NodeId, Pose2> both{{NodeId{0}, {2.0, 2.0, 0.0}}, {NodeId{1}, {6.0, 2.0, 0.0}}};
  EXPECT_NEAR(judgeMission(space, kStart, both, Edges{}, kForward).coverage, 1.0, 0.02);
}

TEST(MissionTruth, coverageGrowsWithTheForwardDistance)
{
  const FreeSpace space = twoRooms();
  const std::map<NodeId, Pose2> corner{{NodeId{0}, {0.4, 0.4, 0.0}}};
  // A quarter circle of 0.75 m of some 24 m^2.
  EXPECT_NEAR(judgeMission(space, kStart, corner, Edges{}, 0.5).coverage, 0.025, 0.01);
  EXPECT_GT(judgeMission(space, kStart, corner, Edges{}, 2.0).coverage, 0.2);
}

TEST(MissionTruth, whatCannotBeReachedNeedNoCovering)
{
  const FreeSpace closed = twoRooms(0.3F);
  const std::map<NodeId, Pose2> one{{NodeId{0}, {2.0, 2.0, 0.0}}};
  EXPECT_NEAR(judgeMission(closed, kStart, one, Edges{}, kForward).coverage, 1.0, 0.02);
}

TEST(MissionTruth, edgeThroughAWallIsFalseOneThroughTheDoorIsNot)
{
  const FreeSpace space = twoRooms();
  const std::map<NodeId, Pose2> nodes{{NodeId{0}, {3.0, 0.6, 0.0}},
                                      {NodeId{1}, {5.0, 0.6, 0.0}},
                                      {NodeId{2}, {3.0, 3.4, 0.0}},
                                      {NodeId{3}, {5.0, 3.4, 0.0}}};
  const auto falseEdges = [&](const Edges &edges) {
    return judgeMission(space, kStart, nodes, edges, kForward).falseEdges;
  };
  EXPECT_EQ(falseEdges({{NodeId{2}, NodeId{3}}}), 0);
  EXPECT_EQ(falseEdges({{NodeId{0}, NodeId{2}}, {NodeId{1}, NodeId{3}}}), 0);
  EXPECT_EQ(falseEdges({{NodeId{0}, NodeId{1}}, {NodeId{2}, NodeId{3}}}), 1);
  EXPECT_EQ(falseEdges({{NodeId{0}, NodeId{9}}}), 1) << "a node that is nowhere";
}

TEST(MissionTruth, nearNodesInSightAreDuplicatesNotThoseBehindAWall)
{
  const FreeSpace space = twoRooms();
  const auto duplicates = [&](const Pose2 &a, const Pose2 &b) {
    return judgeMission(space, kStart, {{NodeId{0}, a}, {NodeId{1}, b}}, Edges{}, kForward)
        .duplicateNodes;
  };
  EXPECT_EQ(duplicates({2.0, 2.0, 0.0}, {2.3, 2.3, 1.0}), 1);
  EXPECT_EQ(duplicates({2.0, 2.0, 0.0}, {2.4, 2.4, 1.0}), 0);
  EXPECT_EQ(duplicates({3.85, 1.0, 0.0}, {4.25, 1.0, 0.0}), 0);
}

TEST(MissionTruth, ofAMapOnlyItsOwnNodesCount)
{
  const FreeSpace space = twoRooms();
  TopologicalMap map;
  map.apply(NodeAdded{{NodeId{0}}});
  map.apply(NodeAdded{{NodeId{1}}});
  map.apply(EdgeAdded{{EdgeId{0}, NodeId{0}, NodeId{1}}});
  const std::map<NodeId, Pose2> nodes{
      {NodeId{0}, {3.0, 0.6, 0.0}}, {NodeId{1}, {5.0, 0.6, 0.0}}, {NodeId{2}, {3.1, 0.6, 0.0}}};
  const MissionTruth truth = judgeMission(space, kStart, nodes, map, kForward);
  EXPECT_EQ(truth.falseEdges, 1);
  EXPECT_EQ(truth.duplicateNodes, 0);
}

} // namespace
} // namespace homeward
