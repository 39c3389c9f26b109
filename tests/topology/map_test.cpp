// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/topology/map.h>

#include <gmock/gmock.h>

#include <limits>

namespace homeward
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two places, one edge, and a way east of place 0 that nobody has driven:
//
//     0 --- 1
//     |
//    (open)
TopologicalMap twoPlaces()
{
  TopologicalMap map;
  map.apply(NodeAdded{{{0},
                       {{{0}, 0.0, 0.4, DirectionState::Driven, "edge 0"},
                        {{1}, -1.5, 0.6, DirectionState::Open, ""}}}});
  map.apply(NodeAdded{{{1}, {{{0}, 3.0, 0.3, DirectionState::Driven, "came from here"}}}});
  map.apply(EdgeAdded{{{0}, {0}, {1}, 0.0, std::nullopt}});
  return map;
}

/** The change is refused with a message that holds `message`, and the map stays as it was. */
void expectRefused(const MapChange &change, const std::string &message)
{
  TopologicalMap map = twoPlaces();
  try {
    map.apply(change);
    ADD_FAILURE() << "accepted, expected: " << message;
  }
  catch (const LogicError &error) {
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
  EXPECT_EQ(map, twoPlaces());
}

TEST(TopologicalMap, StartsEmpty)
{
  const TopologicalMap map;
  EXPECT_EQ(map.nextNodeId(), NodeId{0});
  EXPECT_EQ(map.nextEdgeId(), EdgeId{0});
  EXPECT_EQ(map.openDirectionCount(), 0);
}

TEST(TopologicalMap, AnswersWhatWasAdded)
{
  const TopologicalMap map = twoPlaces();
  EXPECT_EQ(map.nextNodeId(), NodeId{2});
  EXPECT_EQ(map.nextEdgeId(), EdgeId{1});
  EXPECT_TRUE(map.contains({1}));
  EXPECT_FALSE(map.contains({2}));
  EXPECT_THAT(map.neighbours({0}), ElementsAre(NodeId{1}));
  EXPECT_THAT(map.neighbours({1}), ElementsAre(NodeId{0}));
  EXPECT_TRUE(map.hasOpenDirection({0}));
  EXPECT_FALSE(map.hasOpenDirection({1}));
  EXPECT_EQ(map.openDirectionCount(), 1);
}

TEST(TopologicalMap, FindsAnEdgeFromEitherEnd)
{
  const TopologicalMap map = twoPlaces();
  ASSERT_TRUE(map.edgeBetween({0}, {1}));
  EXPECT_EQ(map.edgeBetween({0}, {1}), map.edgeBetween({1}, {0}));
  EXPECT_EQ(map.edgeBetween({0}, {0}), std::nullopt);
  EXPECT_EQ(map.departureBearing({0}, {1}), 0.0);
  EXPECT_EQ(map.departureBearing({1}, {0}), std::nullopt);
}

TEST(TopologicalMap, NeighboursComeInOrderOfTheirIds)
{
  TopologicalMap map;
  for (int i = 0; i < 4; ++i) {
    map.apply(NodeAdded{{{i}, {}}});
  }
  map.apply(EdgeAdded{{{0}, {0}, {3}}});
  map.apply(EdgeAdded{{{1}, {1}, {0}}});
  map.apply(EdgeAdded{{{2}, {0}, {2}}});
  EXPECT_THAT(map.neighbours({0}), ElementsAre(NodeId{1}, NodeId{2}, NodeId{3}));
}

TEST(TopologicalMap, SettlesADirectionOnce)
{
  TopologicalMap map = twoPlaces();
  map.apply(DirectionSettled{{0}, {1}, DirectionState::Closed, "blocked"});
  EXPECT_EQ(map.node({0}).directions[1].state, DirectionState::Closed);
  EXPECT_EQ(map.node({0}).directions[1].reason, "blocked");
  EXPECT_FALSE(map.hasOpenDirection({0}));
  EXPECT_THROW(map.apply(DirectionSettled{{0}, {1}, DirectionState::Driven, ""}), LogicError);
  EXPECT_EQ(map.node({0}).directions[1].state, DirectionState::Closed);
}

TEST(TopologicalMap, RefusesIdsThatAreNotTheNextOnes)
{
  expectRefused(NodeAdded{{{1}, {}}}, "node 1 cannot be added: the next id is 2");
  expectRefused(NodeAdded{{{3}, {}}}, "node 3 cannot be added: the next id is 2");
  expectRefused(NodeAdded{{{2}, {{{1}, 0.0, 0.1}}}}, "direction 1 of node 2: the next id is 0");
  expectRefused(EdgeAdded{{{0}, {0}, {1}}}, "edge 0 cannot be added: the next id is 1");
}

TEST(TopologicalMap, RefusesImpossibleEdges)
{
  expectRefused(EdgeAdded{{{1}, {1}, {1}}}, "joins node 1 to itself");
  expectRefused(EdgeAdded{{{1}, {1}, {0}}}, "node 1 and node 0 are already joined by edge 0");
  expectRefused(EdgeAdded{{{1}, {0}, {7}}}, "node 7 is unknown");
  expectRefused(EdgeAdded{{{1}, {-1}, {0}}}, "node -1 is unknown");
}

TEST(TopologicalMap, RefusesImpossibleDirections)
{
  const double inf = std::numeric_limits<double>::infinity();
  expectRefused(NodeAdded{{{2}, {{{0}, inf, 0.1}}}}, "bearing inf is not finite");
  expectRefused(NodeAdded{{{2}, {{{0}, 0.0, -0.1}}}}, "width -0.1");
  expectRefused(DirectionSettled{{0}, {2}, DirectionState::Closed, ""}, "direction 2 of node 0");
  expectRefused(DirectionSettled{{0}, {-1}, DirectionState::Closed, ""}, "direction -1 of node 0");
  expectRefused(DirectionSettled{{5}, {0}, DirectionState::Closed, ""}, "node 5 is unknown");
  expectRefused(DirectionSettled{{0}, {1}, DirectionState::Open, ""}, "cannot be settled as open");
  expectRefused(DirectionSettled{{0}, {0}, DirectionState::Closed, ""}, "is already driven");
}

TEST(TopologicalMap, RefusesAnEdgeBearingThatIsNoAngle)
{
  TopologicalMap map = twoPlaces();
  map.apply(NodeAdded{{{2}, {}}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map.apply(EdgeAdded{{{1}, {1}, {2}, nan, std::nullopt}}), LogicError);
  EXPECT_THROW(map.apply(EdgeAdded{{{1}, {1}, {2}, std::nullopt, nan}}), LogicError);
  EXPECT_EQ(map.edges().size(), 1U);
}

TEST(DirectionState, NameAndParseAreInverse)
{
  for (const DirectionState state :
       {DirectionState::Open, DirectionState::Driven, DirectionState::Closed}) {
    EXPECT_EQ(parseDirectionState(name(state)), state);
  }
  EXPECT_EQ(parseDirectionState("Open"), std::nullopt);
}

} // namespace
} // namespace homeward
