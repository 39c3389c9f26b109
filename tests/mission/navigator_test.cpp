// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid_world.h"

#include <homeward/core/error.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

//  0 - 1 - 2
//      |
//      3        4 stands alone
struct NavigatorTest : testing::Test
{
  NavigatorTest() : world({"...", ".. ", "  ."}, {0, 0})
  {
    for (std::int64_t i = 0; i < 5; ++i) {
      map.apply(NodeAdded{{NodeId{i}, {}}});
    }
    map.apply(EdgeAdded{{EdgeId{0}, NodeId{0}, NodeId{1}, 0.0, kPi - 0.001, 1.0}});
    map.apply(EdgeAdded{{EdgeId{1}, NodeId{1}, NodeId{2}, 0.0, kPi - 0.001, 1.0}});
    map.apply(EdgeAdded{{EdgeId{2}, NodeId{1}, NodeId{3}}});
    world.nodes = {{0, 0}, {1, 0}, {2, 0}, {1, 1}, {2, 2}};
  }

  Finish navigate(NodeId goal)
  {
    const Navigator navigator({});
    auto step = navigator.start(map, goal);
    for (int i = 0; i < 200; ++i) {
      if (const auto *finish = std::get_if<Finish>(&step.command)) {
        last = step.state;
        return *finish;
      }
      step = navigator.next(step.state, map, world.execute(step.command));
    }
    ADD_FAILURE() << "the navigation does not end";
    return {};
  }

  TopologicalMap map;
  GridWorld world;
  NavigatorState last;
};

TEST_F(NavigatorTest, FollowsTheShortestPath)
{
  EXPECT_EQ(navigate(NodeId{3}).outcome, Outcome::Done);
  EXPECT_EQ(last.visited, (std::vector<NodeId>{NodeId{0}, NodeId{1}, NodeId{3}}));
}

TEST_F(NavigatorTest, IsThereWhenItStandsAtTheGoal)
{
  EXPECT_EQ(navigate(NodeId{0}).outcome, Outcome::Done);
  EXPECT_EQ(world.homedTo.size(), 1U);
}

TEST_F(NavigatorTest, SaysUnreachable)
{
  const Finish finish = navigate(NodeId{4});
  EXPECT_EQ(finish.outcome, Outcome::Failed);
  EXPECT_NE(finish.reason.find("unreachable"), std::string::npos);
}

TEST_F(NavigatorTest, TriesAgainAfterAFailedLeg)
{
  world.homingFailures = 1;
  EXPECT_EQ(navigate(NodeId{2}).outcome, Outcome::Done);
}

TEST_F(NavigatorTest, DrivesALegAsItWasDrivenWhenSightDoesNotReach)
{
  world.shortSighted = true;
  EXPECT_EQ(navigate(NodeId{2}).outcome, Outcome::Done);
  EXPECT_EQ(last.visited,
            (std::vector<NodeId>{NodeId{0}, NodeId{0}, NodeId{1}, NodeId{1}, NodeId{2}}));
}

TEST_F(NavigatorTest, SaysUnreachableWhenSightDoesNotReachAndTheWayIsUnknown)
{
  world.shortSighted = true;
  const Finish finish = navigate(NodeId{3});
  EXPECT_EQ(finish.outcome, Outcome::Failed);
  EXPECT_NE(finish.reason.find("unreachable"), std::string::npos);
}

TEST_F(NavigatorTest, SaysLostWhenNoPlaceCanBeReached)
{
  world.homingFailures = 1000;
  const Finish finish = navigate(NodeId{2});
  EXPECT_EQ(finish.outcome, Outcome::Failed);
  EXPECT_NE(finish.reason.find("lost"), std::string::npos);
}

TEST_F(NavigatorTest, MakesSureOfAPlaceOutOfNowhereButNotOfTheOneLeft)
{
  world.shortSighted = true;
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(last.visited, (std::vector<NodeId>{NodeId{0}, NodeId{0}, NodeId{1}}));
  EXPECT_EQ(world.madeSureOf, std::vector<NodeId>{NodeId{0}});
}

TEST_F(NavigatorTest, TriesABarredLegOnceMoreWhereNoOtherWayLeadsOn)
{
  const Navigator navigator({});
  auto step = navigator.start(map, NodeId{1}, NodeId{0});
  step = navigator.next(step.state, map, world.execute(step.command));
  world.barredHomings = 1;
  EXPECT_FALSE(std::get<HomeTo>(step.command).again);
  step = navigator.next(step.state, map, world.execute(step.command));
  EXPECT_EQ(step.state.phase, NavigatorState::Phase::Following);
  EXPECT_TRUE(std::get<HomeTo>(step.command).again);
  step = navigator.next(step.state, map, world.execute(step.command));
  EXPECT_EQ(std::get<Finish>(step.command).outcome, Outcome::Done);
}

TEST_F(NavigatorTest, SearchesNothingWhenTheOnlyLegStaysBarred)
{
  const Navigator navigator({});
  auto step = navigator.start(map, NodeId{1}, NodeId{0});
  step = navigator.next(step.state, map, world.execute(step.command));
  step = navigator.next(step.state, map, Homed{HomingEnd::Blocked, {}});
  ASSERT_TRUE(std::get<HomeTo>(step.command).again);
  step = navigator.next(step.state, map, Homed{HomingEnd::Lost, {}}); // beside what bars it
  ASSERT_TRUE(std::holds_alternative<Finish>(step.command));
  EXPECT_EQ(std::get<Finish>(step.command).reason,
            "unreachable: no way from node 0 to node 1; blocked: 0 - 1");
}

TEST_F(NavigatorTest, SaysWhichLegIsBarredWhenNoOtherWayLeadsOn)
{
  world.barred = {{{0, 0}, {1, 0}}};
  const Finish finish = navigate(NodeId{2});
  EXPECT_EQ(finish.outcome, Outcome::Failed);
  EXPECT_EQ(finish.reason, "unreachable: no way from node 0 to node 2; blocked: 0 - 1");
  EXPECT_EQ(world.homedTo, (std::vector<NodeId>{NodeId{0}, NodeId{1}, NodeId{1}}));
}

//  0 - 1 - 2
//   \  |
//      3
TEST_F(NavigatorTest, GoesAnotherWayAtOnceRoundABarredLeg)
{
  map.apply(EdgeAdded{{map.nextEdgeId(), NodeId{0}, NodeId{3}}});
  world.barred = {{{0, 0}, {1, 0}}};
  EXPECT_EQ(navigate(NodeId{2}).outcome, Outcome::Done);
  EXPECT_EQ(world.homedTo, (std::vector<NodeId>{NodeId{0}, NodeId{1}, NodeId{0}, NodeId{3},
                                                NodeId{1}, NodeId{2}}));
}

TEST_F(NavigatorTest, TakesALegForBarredThatItCannotEvenDrive)
{
  const Navigator navigator({});
  auto step = navigator.start(map, NodeId{1}, NodeId{0});
  step = navigator.next(step.state, map, world.execute(step.command));
  step = navigator.next(step.state, map, Homed{HomingEnd::Lost, {}}); // the leg
  step = navigator.next(step.state, map, world.execute(step.command));
  step = navigator.next(step.state, map, world.execute(step.command));
  ASSERT_EQ(step.state.phase, NavigatorState::Phase::Striding);
  step = navigator.next(step.state, map, Driven{true, {0.3, 0.3, 0.0, 0.0}});
  EXPECT_EQ(step.state.blocked, std::set<EdgeId>{EdgeId{0}});
}

TEST_F(NavigatorTest, TellsThePilotWhereTheMapHasThePlace)
{
  const Navigator navigator({});
  auto step = navigator.start(map, NodeId{2}, NodeId{0});
  step = navigator.next(step.state, map, world.execute(step.command));
  const auto known = std::get<HomeTo>(step.command);
  ASSERT_TRUE(known.way);
  EXPECT_EQ(known.way->bearing, 0.0);
  EXPECT_EQ(known.way->distance, 1.0);
}

TEST_F(NavigatorTest, GoesBackToTheNodeLeftRatherThanFindingOutWhereItIs)
{
  const Navigator navigator({});
  auto step = navigator.start(map, NodeId{3}, NodeId{0});
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{0});
  step = navigator.next(step.state, map, Homed{HomingEnd::Lost, {}});
  EXPECT_TRUE(std::holds_alternative<Recognise>(step.command));
}

TEST_F(NavigatorTest, KnowsNothingOfWhereItIsWhenLost)
{
  world.homingFailures = 1000;
  navigate(NodeId{2});
  EXPECT_FALSE(last.here);
}

TEST_F(NavigatorTest, CallsPlacesAsPeopleDo)
{
  map.apply(NodeNamed{NodeId{3}, "kitchen"});
  EXPECT_EQ(navigate(NodeId{3}).reason, "arrived at kitchen");
}

/** Drives from node 0 to its neighbour 1, a metre east of it. */
struct RefreshTest : NavigatorTest
{
  /** What is refreshed when this is the answer to the last leg. */
  std::vector<NodeId> refreshedAfter(const Homed &report, NodeId goal = NodeId{1})
  {
    const Navigator navigator(options);
    auto step = navigator.start(map, goal, report.chord.distance > 0.0 ? NodeId{0} : NodeId{1});
    step = navigator.next(step.state, map, Homed{HomingEnd::Arrived, {}});
    asked = std::get<HomeTo>(step.command).seeAnew;
    step = navigator.next(step.state, map, report);
    return step.refreshes;
  }

  static Homed arrival(const SeenAnew &seen)
  {
    return {HomingEnd::Arrived, {1.1, 1.2, 0.1, -3.0}, 5.0, 9.0, seen};
  }

  static constexpr SeenAnew kChanged{0.999, true, 0.4};

  NavigatorOptions options{.refresh = {.wanted = true}};
  bool asked = false; ///< to see the goal anew
};

TEST_F(RefreshTest, AGoalThatNoLongerLooksAsItDidGetsANewPicture)
{
  EXPECT_EQ(refreshedAfter(arrival(kChanged)), std::vector<NodeId>{NodeId{1}});
  EXPECT_TRUE(asked);
}

TEST_F(RefreshTest, NobodyAskedNothingIsRefreshed)
{
  options.refresh.wanted = false;
  EXPECT_TRUE(refreshedAfter(arrival(kChanged)).empty());
  EXPECT_FALSE(asked);
}

TEST_F(RefreshTest, APlaceThatLooksAsItDidKeepsItsPicture)
{
  EXPECT_TRUE(refreshedAfter(arrival({0.999, true, 0.1})).empty());
}

TEST_F(RefreshTest, NothingIsOverwrittenByWhatMayBeAPlaceThatLooksAlike)
{
  EXPECT_TRUE(refreshedAfter(arrival({0.9, true, 0.4})).empty());
  EXPECT_TRUE(refreshedAfter(arrival({0.999, false, 0.4})).empty());
}

TEST_F(RefreshTest, NothingIsOverwrittenWhereTheWayDoesNotLead)
{
  Homed report = arrival(kChanged);
  report.chord.distance = 2.0;
  EXPECT_TRUE(refreshedAfter(report).empty());
  report = arrival(kChanged);
  report.chord.bearingAtOrigin = 1.0;
  EXPECT_TRUE(refreshedAfter(report).empty());
}

TEST_F(RefreshTest, NothingIsOverwrittenWhereNobodyKnowsWhereTheWayLeads)
{
  Homed report = arrival(kChanged);
  report.chord = {};
  EXPECT_TRUE(refreshedAfter(report, NodeId{3}).empty());
  EXPECT_TRUE(asked);
}

TEST_F(RefreshTest, NothingIsOverwrittenBeforeTheRobotIsThere)
{
  EXPECT_TRUE(refreshedAfter({HomingEnd::Arrived, {1.0, 1.0, 0.0, kPi}}).empty());
  Homed report = arrival(kChanged);
  report.end = HomingEnd::Lost;
  EXPECT_TRUE(refreshedAfter(report).empty());
}

TEST_F(RefreshTest, OnlyTheGoalIsSeenAnew)
{
  refreshedAfter(arrival(kChanged), NodeId{2});
  EXPECT_FALSE(asked);
}

/** The robot was put down where no node is; some of the world is drawn above each test. */
struct PutDownTest : NavigatorTest
{
  /** Node 1 stands at `goal`, all others out of the world. */
  void putDown(const std::vector<std::string> &rows, GridWorld::Cell robot, GridWorld::Cell goal)
  {
    world = GridWorld(rows, robot);
    world.nodes.assign(map.nodes().size(), {-9, -9});
    world.nodes[1] = goal;
  }
};

TEST_F(PutDownTest, DrivesToAnUnlikelyPlaceAndMakesSureOfIt)
{
  putDown({".."}, {1, 0}, {0, 0});
  world.besideProbability = 0.3;
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(world.madeSureOf, std::vector<NodeId>{NodeId{1}});
  EXPECT_TRUE(world.driven.empty());
}

TEST_F(PutDownTest, DoesNotBelieveInAPlaceThatLooksAlike)
{
  putDown({".."}, {1, 0}, {-9, -9});
  world.impostor = NodeId{0};
  const Finish finish = navigate(NodeId{1});
  EXPECT_EQ(finish.outcome, Outcome::Failed);
  EXPECT_NE(finish.reason.find("lost"), std::string::npos);
  EXPECT_TRUE(last.visited.empty());
}

TEST_F(PutDownTest, ComesCloseToTheFirstPlaceAndIsNotPatient)
{
  const NavigatorOptions options{.approachSeconds = 17.0};
  const Navigator navigator(options);
  const auto step = navigator.start(map, NodeId{1});
  const Recognised seen{{{NodeId{0}, 0.5, false, 200.0}}};
  const auto approach = std::get<HomeTo>(navigator.next(step.state, map, seen).command);
  EXPECT_TRUE(approach.closely);
  EXPECT_EQ(approach.patience, 17.0);
}

// r, where node 1 is, and a place beside it
TEST_F(PutDownTest, TriesAPlaceAgainThatWasBarred)
{
  putDown({".."}, {0, 0}, {0, 0});
  world.barredHomings = 1;
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(world.homedTo, (std::vector<NodeId>{NodeId{1}, NodeId{1}}));
  EXPECT_TRUE(world.driven.empty());
}

// 1 r .
TEST_F(PutDownTest, BelievesAgainFromElsewhereInAPlaceThatWasNotReached)
{
  putDown({"..."}, {1, 0}, {0, 0});
  world.besideProbability = 0.9;
  world.homingFailures = 1;
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(world.homedTo, (std::vector<NodeId>{NodeId{1}, NodeId{1}}));
  EXPECT_EQ(world.driven.size(), 3U); // away, against the wall, back
}

TEST_F(PutDownTest, FindsItsPlaceBehindOneThatLooksAlike)
{
  putDown({"....."}, {3, 0}, {0, 0});
  world.impostor = NodeId{0};
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(last.visited, std::vector<NodeId>{NodeId{1}});
}

// 1 . . r .
TEST_F(PutDownTest, LooksElsewhereAlongTheMostOpenWayAndGoesStraightOn)
{
  putDown({"....."}, {3, 0}, {0, 0});
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(world.surveys, 1);
  ASSERT_EQ(world.driven.size(), 3U);
  EXPECT_NEAR(std::abs(world.driven.front()), kPi, 1e-6);
  EXPECT_EQ(world.driven.front(), world.driven.back());
}

// . . r 1
TEST_F(PutDownTest, TakesAnotherWayWhenOneIsBarred)
{
  putDown({"...."}, {2, 0}, {3, 0});
  world.blockedDrives = 1;
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(world.surveys, 1);
  ASSERT_EQ(world.driven.size(), 2U);
  EXPECT_NEAR(world.driven.back(), 0.0, 1e-6);
}

// . . r . .
//         .
//         1
TEST_F(PutDownTest, RatherGoesOnThanBack)
{
  putDown({".....", "    .", "    ."}, {2, 0}, {4, 2});
  EXPECT_EQ(navigate(NodeId{1}).outcome, Outcome::Done);
  EXPECT_EQ(world.surveys, 2);
  EXPECT_EQ(world.driven.size(), 5U); // two, one against the wall, two
}

TEST_F(PutDownTest, SaysLostWhenNoWayIsOpen)
{
  putDown({"."}, {0, 0}, {-9, -9});
  const Finish finish = navigate(NodeId{1});
  EXPECT_EQ(finish.outcome, Outcome::Failed);
  EXPECT_NE(finish.reason.find("lost"), std::string::npos);
}

TEST_F(PutDownTest, SaysLostAfterManyLooks)
{
  putDown({"...", ". .", "..."}, {0, 0}, {-9, -9});
  const Finish finish = navigate(NodeId{1});
  EXPECT_EQ(finish.outcome, Outcome::Failed);
  EXPECT_NE(finish.reason.find("lost"), std::string::npos);
  EXPECT_GE(world.driven.size(), 10U);
}

TEST_F(NavigatorTest, RefusesAnUnknownGoal)
{
  EXPECT_THROW(Navigator({}).start(map, NodeId{9}), LogicError);
  EXPECT_THROW(Navigator({}).start(map, NodeId{0}, NodeId{9}), LogicError);
}

} // namespace
} // namespace homeward
