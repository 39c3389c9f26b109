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
using ::testing::IsEmpty;

Node withDirection(std::int64_t id, double bearing)
{
  return {{id}, {{{0}, bearing, 0.3}}};
}

// Place 4 is place 1 once more, seen with the heading turned:
//
//     0 --- 1 --- 2
//     |           |
//     +---- 4 ----+
//           |
//           3
TopologicalMap twiceSeen()
{
  TopologicalMap map;
  for (std::int64_t id = 0; id < 5; ++id) {
    map.apply(NodeAdded{withDirection(id, 0.25)});
  }
  map.apply(EdgeAdded{{{0}, {0}, {1}, 0.1, 3.0, 2.0}});
  map.apply(EdgeAdded{{{1}, {1}, {2}, 0.2, -3.0, 2.0}});
  map.apply(EdgeAdded{{{2}, {4}, {0}, 1.0, 0.5, 2.1}});
  map.apply(EdgeAdded{{{3}, {2}, {4}, 0.3, 2.5, 1.9}});
  map.apply(EdgeAdded{{{4}, {3}, {4}, 0.4, -1.5, 1.5}});
  return map;
}

/** The change is refused with a message that holds `message`, and the map stays as it was. */
void expectRefused(const MapChange &change, const std::string &message)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodeNamed{{2}, "lab"});
  const TopologicalMap before = map;
  try {
    map.apply(change);
    ADD_FAILURE() << "accepted, expected: " << message;
  }
  catch (const LogicError &error) {
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
  EXPECT_EQ(map, before);
}

TEST(NodeNamed, NamesANodeAndTakesTheNameAway)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodeNamed{{2}, "the lab, upstairs"});
  EXPECT_EQ(map.node({2}).name, "the lab, upstairs");
  EXPECT_EQ(map.find("the lab, upstairs"), NodeId{2});
  EXPECT_EQ(map.find("2"), NodeId{2});
  EXPECT_EQ(map.find("17"), std::nullopt);
  EXPECT_EQ(map.find(""), std::nullopt);
  map.apply(NodeNamed{{2}, "lab"});
  EXPECT_EQ(map.find("the lab, upstairs"), std::nullopt);
  map.apply(NodeNamed{{2}, ""});
  EXPECT_EQ(map, twiceSeen());
}

TEST(NodeNamed, ANameIsFreeAgainWhenItsNodeIsGone)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodeNamed{{2}, "lab"});
  map.apply(NodeRemoved{{2}});
  EXPECT_EQ(map.find("lab"), std::nullopt);
  map.apply(NodeNamed{{0}, "lab"});
  EXPECT_EQ(map.find("lab"), NodeId{0});
}

TEST(NodeNamed, RefusesWhatIsNoNameOrTaken)
{
  expectRefused(NodeNamed{{1}, "lab"}, "the name \"lab\" for node 1 is that of node 2");
  expectRefused(NodeNamed{{1}, "0012"}, "the name \"0012\" for node 1 is a number");
  expectRefused(NodeNamed{{1}, "two\nlines"}, "a name for node 1 has control characters");
  expectRefused(NodeNamed{{9}, "hall"}, "node 9 is unknown");
  expectRefused(NodeAdded{{{5}, {}, "lab"}}, "the name \"lab\" for node 5 is that of node 2");
}

TEST(NodeRemoved, TakesItsEdgesAlongAndIdsAreNeverReused)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodeRemoved{{4}});
  EXPECT_FALSE(map.contains({4}));
  EXPECT_EQ(map.nextNodeId(), NodeId{5});
  EXPECT_EQ(map.nextEdgeId(), EdgeId{5});
  EXPECT_EQ(map.edges().size(), 2U);
  EXPECT_THAT(map.neighbours({0}), ElementsAre(NodeId{1}));
  EXPECT_THAT(map.neighbours({3}), IsEmpty());
  EXPECT_THROW(map.apply(NodeAdded{{{4}, {}}}), LogicError);
  map.apply(NodeAdded{{{5}, {}}});
  map.apply(EdgeAdded{{{5}, {5}, {3}}});
  EXPECT_EQ(map.edgeBetween({3}, {5})->id, EdgeId{5});
  expectRefused(NodeRemoved{{7}}, "node 7 is unknown");
}

TEST(EdgeRemoved, LeavesItsPlaces)
{
  TopologicalMap map = twiceSeen();
  map.apply(EdgeRemoved{{1}});
  EXPECT_EQ(map.edgeBetween({1}, {2}), std::nullopt);
  EXPECT_THAT(map.neighbours({2}), ElementsAre(NodeId{4}));
  EXPECT_EQ(map.links({2})[0].edge, EdgeId{3});
  EXPECT_THROW(map.apply(EdgeRemoved{{1}}), LogicError);
  map.apply(EdgeAdded{{{5}, {2}, {1}}});
  EXPECT_EQ(map.edgeBetween({1}, {2})->id, EdgeId{5});
  expectRefused(EdgeRemoved{{-1}}, "edge -1 is unknown");
}

TEST(EdgeForbidden, IsLiftedAgain)
{
  TopologicalMap map = twiceSeen();
  map.apply(EdgeForbidden{{1}});
  EXPECT_TRUE(map.edge({1}).forbidden);
  map.apply(EdgeForbidden{{1}, false});
  EXPECT_EQ(map, twiceSeen());
  expectRefused(EdgeForbidden{{8}}, "edge 8 is unknown");
}

TEST(EdgeTried, CountsAndAverages)
{
  TopologicalMap map = twiceSeen();
  map.apply(EdgeTried{{1}, "", 10.0, 100.0});
  map.apply(EdgeTried{{1}, "lost", 45.0, 150.0});
  map.apply(EdgeTried{{1}, "", 20.0, 200.0});
  EXPECT_EQ(map.edge({1}).statistics, (EdgeStatistics{3, 2, 15.0, "lost", 200.0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectRefused(EdgeTried{{1}, "", -1.0, 0.0}, "edge 1: -1.000000 s are no duration");
  expectRefused(EdgeTried{{1}, "lost", nan, 0.0}, "are no duration");
  expectRefused(EdgeTried{{1}, "", 1.0, nan}, "edge 1: time nan is not finite");
  expectRefused(EdgeAdded{{{5}, {0}, {2}, {}, {}, {}, {1, 2}}}, "edge 5: 2 successes in 1 tries");
}

TEST(NodesMerged, EdgesMoveWithTheirBearingsTurned)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodesMerged{{1}, {4}, 1.75});
  EXPECT_FALSE(map.contains({4}));
  EXPECT_THAT(map.neighbours({1}), ElementsAre(NodeId{0}, NodeId{2}, NodeId{3}));
  EXPECT_EQ(map.edge({4}), (Edge{{4}, {3}, {1}, 0.4, 0.25, 1.5}));
  EXPECT_EQ(map.node({1}).directions[0].state, DirectionState::Driven);
  EXPECT_EQ(map.node({1}).directions[0].reason, "leads to node 3");
  EXPECT_FALSE(map.hasOpenDirection({1}));
  EXPECT_EQ(map.nextNodeId(), NodeId{5});
}

TEST(NodesMerged, OnlyDirectionsAlongATakenEdgeAreSettled)
{
  for (const auto &[turn, state] : {std::pair{1.75 + 0.59, DirectionState::Driven},
                                    std::pair{1.75 + 0.61, DirectionState::Open}}) {
    TopologicalMap map = twiceSeen();
    map.apply(NodesMerged{{1}, {4}, turn});
    EXPECT_EQ(map.node({1}).directions[0].state, state) << turn;
  }
}

TEST(NodesMerged, OfTwoEdgesToOnePlaceThatOfTheKeptOneStays)
{
  TopologicalMap map = twiceSeen();
  map.apply(EdgeTried{{0}, "", 10.0, 5.0});
  map.apply(EdgeTried{{2}, "", 40.0, 9.0});
  map.apply(EdgeTried{{2}, "", 40.0, 10.0});
  map.apply(EdgeTried{{2}, "blocked", 9.0, 11.0});
  map.apply(EdgeForbidden{{3}});
  map.apply(NodesMerged{{1}, {4}, 0.0});
  EXPECT_EQ(map.edges().size(), 3U);
  EXPECT_EQ(map.edge({0}),
            (Edge{{0}, {0}, {1}, 0.1, 3.0, 2.0, {4, 3, 30.0, "blocked", 11.0}, false}));
  EXPECT_TRUE(map.edge({1}).forbidden);
}

TEST(NodesMerged, AnEdgeBetweenTheTwoDisappears)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodesMerged{{3}, {4}, 0.0});
  EXPECT_FALSE(map.edges().contains({4}));
  EXPECT_THAT(map.neighbours({3}), ElementsAre(NodeId{0}, NodeId{2}));
  EXPECT_EQ(map.departureBearing({3}, {0}), 1.0);
}

TEST(NodesMerged, AnUnknownBearingStaysUnknown)
{
  TopologicalMap map;
  for (std::int64_t id = 0; id < 3; ++id) {
    map.apply(NodeAdded{withDirection(id, 0.0)});
  }
  map.apply(EdgeAdded{{{0}, {2}, {1}}});
  map.apply(NodesMerged{{0}, {2}, 0.0});
  EXPECT_EQ(map.departureBearing({0}, {1}), std::nullopt);
  EXPECT_TRUE(map.hasOpenDirection({0}));
}

TEST(NodesMerged, KeepsAName)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodeNamed{{4}, "lab"});
  map.apply(NodeNamed{{3}, "door"});
  map.apply(NodesMerged{{1}, {4}, 0.0});
  EXPECT_EQ(map.find("lab"), NodeId{1});
  map.apply(NodesMerged{{1}, {3}, 0.0});
  EXPECT_EQ(map.node({1}).name, "lab");
  EXPECT_EQ(map.find("door"), std::nullopt);
}

TEST(NodesMerged, RefusesWhatCannotBeOnePlace)
{
  expectRefused(NodesMerged{{1}, {1}, 0.0}, "node 1 cannot be merged with itself");
  expectRefused(NodesMerged{{1}, {6}, 0.0}, "node 6 is unknown");
  expectRefused(NodesMerged{{6}, {1}, 0.0}, "node 6 is unknown");
  expectRefused(NodesMerged{{1}, {4}, std::numeric_limits<double>::infinity()},
                "the turn inf of node 4 is not finite");
}

TEST(KeptMap, IsTheSameWithItsGaps)
{
  TopologicalMap map = twiceSeen();
  map.apply(NodeRemoved{{1}});
  map.apply(NodeRemoved{{4}});
  std::vector<Node> nodes;
  for (const auto &[id, node] : map.nodes()) {
    nodes.push_back(node);
  }
  EXPECT_EQ(TopologicalMap(nodes, {}, {5}, {5}), map);
  EXPECT_NE(TopologicalMap(nodes, {}, {6}, {5}), map);
  EXPECT_THROW(TopologicalMap(nodes, {}, {3}, {5}), LogicError);
  EXPECT_THROW(TopologicalMap({nodes[1], nodes[0]}, {}, {5}, {5}), LogicError);
  EXPECT_THROW(TopologicalMap(nodes, {{{0}, {0}, {1}}}, {5}, {5}), LogicError);
  EXPECT_THROW(TopologicalMap(nodes, {{{5}, {0}, {2}}}, {5}, {5}), LogicError);
}

TEST(IdMap, SkipsGapsAndNeverGoesBack)
{
  IdMap<NodeId, int> map;
  EXPECT_EQ(map.begin(), map.end());
  map.add(7);
  map.skipTo({3});
  map.add(9);
  std::vector<std::pair<std::int64_t, int>> entries;
  for (const auto &[id, value] : map) {
    entries.emplace_back(id.value, value);
  }
  EXPECT_THAT(entries, ElementsAre(std::pair{0, 7}, std::pair{3, 9}));
  EXPECT_THROW(map.skipTo({3}), LogicError);
  EXPECT_THROW(map.at({2}), LogicError);
  EXPECT_EQ(map.find({-1}), nullptr);
  map.remove({3});
  EXPECT_THROW(map.remove({3}), LogicError);
  EXPECT_EQ(map.next(), NodeId{4});
  EXPECT_EQ(map.size(), 1U);
}

} // namespace
} // namespace homeward
