// SPDX-License-Identifier: GPL-3.0-or-later
#include "explorer_worlds.h"

#include <homeward/core/error.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

TEST(Explorer, EndsWithEveryPlaceKnownOnce)
{
  GridWorld world(ring(), {0, 0});
  const Tour run = explore(world, oneMetre());
  EXPECT_EQ(run.finish.outcome, Outcome::Done);
  const std::set<GridWorld::Cell> places(world.nodes.begin(), world.nodes.end());
  EXPECT_EQ(places.size(), 9U);
  EXPECT_EQ(world.nodes.size(), 9U);
  EXPECT_EQ(run.map.openDirectionCount(), 0);
}

TEST(Explorer, JoinsOnlyNeighbours)
{
  GridWorld world(ring(), {2, 2});
  const Tour run = explore(world, oneMetre());
  EXPECT_EQ(run.map.edges().size(), 9U); // eight round the ring, one to the dead end
  for (const auto &[id, edge] : run.map.edges()) {
    const auto a = world.nodes[static_cast<std::size_t>(edge.a.value)];
    const auto b = world.nodes[static_cast<std::size_t>(edge.b.value)];
    EXPECT_EQ(std::abs(a.first - b.first) + std::abs(a.second - b.second), 1);
  }
}

TEST(Explorer, SeedsBehaviourDrivesEveryDirection)
{
  GridWorld world({"..", ".."}, {0, 0});
  const Tour seed = explore(world, {.forwardDistance = 1.0, .settledAngle = 0.0});
  GridWorld again({"..", ".."}, {0, 0});
  const Tour ours = explore(again, oneMetre());
  EXPECT_EQ(seed.finish.outcome, Outcome::Done);
  EXPECT_EQ(seed.map.edges().size(), ours.map.edges().size());
  EXPECT_GT(seed.steps, ours.steps);
}

TEST(Explorer, WritesTheSeedsTable)
{
  GridWorld world({"..", ".."}, {0, 0});
  const Tour run = explore(world, oneMetre());
  EXPECT_THAT(run.log, testing::ElementsAre(
                           "Exploration 0 - 1 -", "Exploration 1 - 2 -", "Exploration 2 - 3 -",
                           "Exploration(Homing) 3 - 0 100.0", "EXPLORATION DONE - -"));
}

TEST(Explorer, FailedHomingsMakeNoFalseEdge)
{
  for (int failures = 1; failures < 12; ++failures) {
    GridWorld world(ring(), {0, 0});
    world.homingFailures = failures;
    const Tour run = explore(world, oneMetre());
    EXPECT_EQ(run.finish.outcome, Outcome::Done) << failures;
    for (const auto &[id, edge] : run.map.edges()) {
      const auto a = world.nodes[static_cast<std::size_t>(edge.a.value)];
      const auto b = world.nodes[static_cast<std::size_t>(edge.b.value)];
      EXPECT_LE(std::abs(a.first - b.first) + std::abs(a.second - b.second), 1) << failures;
    }
  }
}

TEST(Explorer, TellsPlacesThatLookAlikeApartByTheWaysDriven)
{
  GridWorld world(ring(), {0, 0});
  world.lookAlike = true;
  ExplorerOptions options = oneMetre();
  options.placeSigma = 0.2;
  options.farthest = 1.0; // its ways are exact
  const Tour run = explore(world, options);
  EXPECT_EQ(run.finish.outcome, Outcome::Done);
  EXPECT_EQ(world.nodes.size(), 9U);
  EXPECT_EQ(run.map.edges().size(), 9U);
}

TEST(Explorer, SurveysWhereAPlaceSeenCannotBe)
{
  const Row row;
  EXPECT_TRUE(std::holds_alternative<Survey>(row.whenSeen({NodeId{0}, 1.0, true, 10.0})));
  EXPECT_TRUE(std::holds_alternative<HomeTo>(row.whenSeen({NodeId{1}, 1.0, true, 10.0})));
}

TEST(Explorer, BelievesInNoPlaceBeyondThreeSigmasHoweverAlike)
{
  Row row; // a place is 0.5 m across, a metre of way adds 0.13
  const PlaceMatch sure{NodeId{1}, 1.0, true, 10.0};
  row.report.chord = {0.5, 0.5, 0.0, kPi};
  EXPECT_TRUE(std::holds_alternative<HomeTo>(row.whenSeen(sure)));
  row.report.chord = {0.95, 0.95, 0.0, kPi};
  EXPECT_TRUE(std::holds_alternative<Survey>(row.whenSeen(sure)));
}

TEST(Explorer, WeighsWhatItSeesWithTheWaysDriven)
{
  const Row row; // half a metre from 2, one and a half from 1
  EXPECT_TRUE(std::holds_alternative<HomeTo>(row.whenSeen({NodeId{2}, 0.7, false, 10.0})));
  EXPECT_TRUE(std::holds_alternative<Survey>(row.whenSeen({NodeId{2}, 0.2, false, 10.0})));
  EXPECT_TRUE(std::holds_alternative<HomeTo>(row.whenSeen({NodeId{1}, 0.98, true, 10.0})));
  EXPECT_TRUE(std::holds_alternative<Survey>(row.whenSeen({NodeId{1}, 0.7, false, 10.0})));
}

//  0 - 1 - 2, a metre apart; the robot has driven back from 2 to half a metre off 1.
TEST(Explorer, MakesSureOfAPlaceThatOnlyTheWaysHaveHere)
{
  Row row;
  row.report = {false, {0.6, 0.6, kPi, 0.0}};
  const PlaceMatch doubted{NodeId{1}, 0.15, false, 10.0};
  const Command command = row.whenSeen(doubted);
  ASSERT_TRUE(std::holds_alternative<HomeTo>(command));
  EXPECT_TRUE(std::get<HomeTo>(command).surely);
  row.report = {false, {0.8, 0.8, 0.0, kPi}};
  EXPECT_TRUE(std::holds_alternative<Survey>(row.whenSeen(doubted)));
}

TEST(Explorer, DrivesBackToThePlaceLeftWhereNothingIsRecognised)
{
  Row row;
  row.state.phase = ExplorerState::Phase::Following;
  row.state.route = {NodeId{1}};
  row.state.target = NodeId{1};
  const Explorer explorer(oneMetre());
  const Homed lost{HomingEnd::Blocked, {0.8, 3.0, 0.3, -2.0}};
  auto step = explorer.next(row.state, row.map, lost);
  step = explorer.next(step.state, row.map, Recognised{});
  const auto *back = std::get_if<DriveDirection>(&step.command);
  ASSERT_NE(back, nullptr);
  EXPECT_DOUBLE_EQ(back->bearing, 0.3 - kPi);
  EXPECT_DOUBLE_EQ(back->distance, 0.8);
  step = explorer.next(step.state, row.map, Driven{false, {0.1, 3.7, 0.3, -2.0}});
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{2});
  // Once; then it makes a place of where it is.
  step = explorer.next(step.state, row.map, lost);
  step = explorer.next(step.state, row.map, Recognised{});
  EXPECT_TRUE(std::holds_alternative<Survey>(step.command));
}

TEST(Explorer, MakesNoPlaceThatNoEdgeCouldLeadTo)
{
  Row row;
  row.report.chord = {2.0, 9.0, 0.0, kPi};
  const Explorer explorer(oneMetre());
  auto step = explorer.next(row.state, row.map, row.report);
  step = explorer.next(step.state, row.map, Recognised{});
  ASSERT_TRUE(std::holds_alternative<DriveDirection>(step.command));
  step = explorer.next(step.state, row.map, Driven{});
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{2});
}

//  0 - 1 - 2, a metre apart, and 3 a metre from 1; the robot has left 3 for 1.
Row backFromATurning()
{
  Row row;
  row.map.apply(NodeAdded{{NodeId{3}, {{DirectionId{0}, kPi, 1.0, DirectionState::Open, ""}}}});
  row.map.apply(EdgeAdded{{EdgeId{2}, NodeId{1}, NodeId{3}, 0.0, kPi, 1.0}});
  row.state.origin = NodeId{3};
  row.state.direction = DirectionId{0};
  return row;
}

//  It stands a hand's width off 1, which looks like nothing there.
TEST(Explorer, MakesNoPlaceWhereTheWaysHaveOne)
{
  const Row row = backFromATurning();
  const Explorer explorer(oneMetre());
  const auto arrive = [&](double distance) {
    const Driven driven{false, {distance, distance, kPi, 0.0}};
    const auto step = explorer.next(row.state, row.map, driven);
    return explorer.next(step.state, row.map, Recognised{});
  };
  EXPECT_TRUE(std::holds_alternative<Survey>(arrive(0.6).command));
  const auto step = arrive(0.8);
  const auto *back = std::get_if<DriveDirection>(&step.command);
  ASSERT_NE(back, nullptr);
  EXPECT_DOUBLE_EQ(back->distance, 0.8);
  ASSERT_EQ(step.changes.size(), 1U);
  const auto &settled = std::get<DirectionSettled>(step.changes[0]);
  EXPECT_EQ(settled.state, DirectionState::Closed);
  EXPECT_EQ(settled.reason, "node 1 is there");
}

//  The ways do not have 1 there for sure, but sight has, and homing to it ends beside it.
TEST(Explorer, MakesNoPlaceBesideOneSurelySeenThatItCannotComeTo)
{
  const Row row = backFromATurning();
  const Explorer explorer(oneMetre());
  const Recognised seen{{{NodeId{1}, 0.99, true, 10.0}}};
  const auto comeTo = [&](double metres, HomingEnd end) {
    const Chord chord{metres, 3.0, kPi, 0.0}; // on crooked ways
    auto step = explorer.next(row.state, row.map, Driven{false, chord});
    step = explorer.next(step.state, row.map, seen);
    EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{1});
    step = explorer.next(step.state, row.map, Homed{end, chord});
    return explorer.next(step.state, row.map, seen);
  };
  auto step = comeTo(0.55, HomingEnd::Blocked);
  EXPECT_TRUE(std::holds_alternative<HomeTo>(step.command)); // once more
  step = comeTo(0.55, HomingEnd::Lost);
  ASSERT_TRUE(std::holds_alternative<DriveDirection>(step.command)); // back
  EXPECT_EQ(std::get<DirectionSettled>(step.changes.at(0)).reason, "node 1 is there");
  EXPECT_TRUE(std::holds_alternative<Survey>(comeTo(0.35, HomingEnd::Lost).command));
}

TEST(Explorer, IsAtThePlaceLeftWhereNothingIsRecognisedAHandsWidthOff)
{
  Row row;
  row.map.apply(NodeAdded{{NodeId{3}, {{DirectionId{0}, kPi, 1.0, DirectionState::Open, ""}}}});
  row.state.phase = ExplorerState::Phase::Relocating;
  row.state.origin = NodeId{3};
  row.state.retreated = true;
  const Explorer explorer(oneMetre());
  row.state.chord = {0.2, 4.0, 0.0, kPi};
  auto step = explorer.next(row.state, row.map, Recognised{});
  EXPECT_TRUE(std::holds_alternative<DriveDirection>(step.command));
  row.state.chord = {0.4, 4.0, 0.0, kPi};
  step = explorer.next(row.state, row.map, Recognised{});
  EXPECT_TRUE(std::holds_alternative<Survey>(step.command));
}

//  1 was taken for 0 and is not; later it looks like it again.
TEST(Explorer, RemembersWhichPlacesOnlyLookAlike)
{
  const Explorer explorer(oneMetre());
  const PlaceMatch zero{NodeId{0}, 0.95, true, 10.0};
  AtTheFirstPlace at(explorer);
  auto step = explorer.next(at.step.state, at.map, Driven{false, {1.0, 1.0, 0.0, kPi}});
  step.state.target = NodeId{0};
  step.state.phase = ExplorerState::Phase::Homing;
  step.state.retries = ExplorerOptions{}.homingTries - 1;
  step = explorer.next(step.state, at.map, Homed{HomingEnd::Lost, {1.0, 1.0, 0.0, kPi}});
  step = explorer.next(step.state, at.map, Recognised{{zero}});
  ASSERT_TRUE(std::holds_alternative<Survey>(step.command));
  step = explorer.next(step.state, at.map, Surveyed{{{0.0, 1.0, 3.0}}, {1.0, 1.0, 0.0, kPi}});
  for (const MapChange &change : step.changes) {
    at.map.apply(change);
  }
  EXPECT_THAT(step.state.alike, testing::ElementsAre(std::pair(NodeId{1}, NodeId{0})));
  step = explorer.next(step.state, at.map, Driven{true, {0.7, 0.7, 0.0, kPi}});
  step = explorer.next(step.state, at.map, Recognised{{zero}});
  EXPECT_TRUE(std::holds_alternative<Survey>(step.command));
}

TEST(Explorer, CannotComeToAPlaceWhereItLeftAnother)
{
  Row row;
  row.state.phase = ExplorerState::Phase::Returning;
  row.state.target = NodeId{0};
  const Explorer explorer(oneMetre());
  const auto arrivedAfter = [&](double metres) {
    const Homed report{HomingEnd::Arrived, {metres, 1.0, 0.0, kPi}};
    return explorer.next(row.state, row.map, report);
  };
  EXPECT_TRUE(std::holds_alternative<Recognise>(arrivedAfter(0.1).command));
  EXPECT_TRUE(arrivedAfter(0.1).changes.empty());
  EXPECT_EQ(arrivedAfter(1.0).state.origin, NodeId{0});
}

TEST(Explorer, MakesSureByStrictSightWhereTheWaysReachFarRound)
{
  Row row;
  EXPECT_FALSE(std::get<HomeTo>(row.whenSeen({NodeId{2}, 0.9, true, 10.0})).surely);
  const int last = 12;
  for (int i = 2; i < last; ++i) {
    row.map.apply(NodeAdded{{NodeId{i + 1}, {}}});
    row.map.apply(EdgeAdded{{EdgeId{i}, NodeId{i}, NodeId{i + 1}, kPi / 6, -kPi / 6 + kPi, 1.0}});
  }
  row.state.origin = NodeId{last};
  EXPECT_TRUE(std::get<HomeTo>(row.whenSeen({NodeId{2}, 0.99, true, 10.0})).surely);
}

TEST(Explorer, ComesBackFromADriveThatNoEdgeCanStandForAndGivesUpTheSecondTime)
{
  const Explorer explorer(oneMetre());
  CutOff at;
  at.state.origin = NodeId{0};
  at.state.target = NodeId{1};
  at.state.direction = DirectionId{0};
  at.state.retries = ExplorerOptions{}.homingTries - 1;
  const Chord far{2.0, 9.0, 0.0, kPi};
  Step<ExplorerState> step{at.state, {}, {}, {}};
  for (int drive = 1; drive <= 2; ++drive) {
    step.state.phase = ExplorerState::Phase::Homing;
    step.state.target = NodeId{1};
    step.state.retries = ExplorerOptions{}.homingTries - 1;
    step = explorer.next(step.state, at.map, Homed{HomingEnd::TimedOut, far});
    step = explorer.next(step.state, at.map, Recognised{});
    ASSERT_TRUE(std::holds_alternative<DriveDirection>(step.command)); // by odometry first
    step = explorer.next(step.state, at.map, Driven{});
    ASSERT_TRUE(std::holds_alternative<HomeTo>(step.command));
    EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{0});
    step = explorer.next(step.state, at.map, Homed{HomingEnd::Arrived, far});
    EXPECT_EQ(std::holds_alternative<DriveDirection>(step.command), drive == 1);
  }
  ASSERT_EQ(step.changes.size(), 1U);
  EXPECT_EQ(std::get<DirectionSettled>(step.changes[0]).reason, "given up after 2 drives");
}

TEST(Explorer, BlockedAtOnceClosesTheDirection)
{
  const Explorer explorer(oneMetre());
  AtTheFirstPlace at(explorer);
  ASSERT_TRUE(std::holds_alternative<DriveDirection>(at.step.command));
  const auto step = explorer.next(at.step.state, at.map, Driven{true, {0.2, 0.2, 0.0, kPi}, 1.8});
  ASSERT_EQ(step.changes.size(), 1U);
  const auto &settled = std::get<DirectionSettled>(step.changes[0]);
  EXPECT_EQ(settled.state, DirectionState::Closed);
  EXPECT_EQ(settled.reason, "too narrow");
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{0});
}

TEST(Explorer, TriesADirectionAgainThatSomebodyStandsIn)
{
  const Explorer explorer(oneMetre());
  AtTheFirstPlace at(explorer);
  const Driven somebody{true, {0.1, 0.1, 0.0, kPi}, 0.5};
  auto step = explorer.next(at.step.state, at.map, somebody);
  EXPECT_TRUE(step.changes.empty());
  step = explorer.next(step.state, at.map, Homed{HomingEnd::Arrived, {}});
  ASSERT_TRUE(std::holds_alternative<DriveDirection>(step.command));
  step = explorer.next(step.state, at.map, somebody);
  ASSERT_EQ(step.changes.size(), 1U);
  EXPECT_EQ(std::get<DirectionSettled>(step.changes[0]).reason, "given up after 2 drives");
}

TEST(Explorer, TriesTheOnlyWayAgainThoughItFailed)
{
  const Explorer explorer(oneMetre());
  TopologicalMap map;
  map.apply(NodeAdded{{NodeId{0}, {}}});
  map.apply(NodeAdded{{NodeId{1}, {{DirectionId{0}, 0.5, 1.0, DirectionState::Open, ""}}}});
  map.apply(EdgeAdded{{EdgeId{0}, NodeId{0}, NodeId{1}, 0.0, kPi}});
  ExplorerState state;
  state.phase = ExplorerState::Phase::Homing;
  state.origin = NodeId{0};
  state.target = NodeId{0};
  for (int failed = 0; failed < ExplorerOptions{}.legTries; ++failed) {
    state.failures[EdgeId{0}] = failed;
    const auto step = explorer.next(state, map, Homed{HomingEnd::Arrived, {}});
    EXPECT_TRUE(std::holds_alternative<HomeTo>(step.command)) << failed;
  }
  state.failures[EdgeId{0}] = ExplorerOptions{}.legTries;
  auto step = explorer.next(state, map, Homed{HomingEnd::Arrived, {}});
  EXPECT_TRUE(std::holds_alternative<Recognise>(step.command));
  // Nothing that leads on is seen: better that way once more than to give up.
  step = explorer.next(step.state, map, Recognised{});
  EXPECT_TRUE(std::holds_alternative<HomeTo>(step.command));
  state.failures[EdgeId{0}] = 1000;
  step = explorer.next(state, map, Homed{HomingEnd::Arrived, {}});
  while (std::holds_alternative<Recognise>(step.command)) {
    step = explorer.next(step.state, map, Recognised{});
  }
  EXPECT_TRUE(std::holds_alternative<Finish>(step.command));
}

TEST(Explorer, SaysWhereTheWaysHaveThePlaceThatItHomesTo)
{
  Row row;
  const auto home = std::get<HomeTo>(row.whenSeen({NodeId{1}, 0.99, true, 10.0}));
  ASSERT_TRUE(home.way);
  EXPECT_NEAR(home.way->distance, 1.0, 1e-12);
  EXPECT_NEAR(std::abs(home.way->bearing), kPi, 1e-12);
  EXPECT_FALSE(home.direct);
}

TEST(Explorer, DrivesALegThatFailedByItsBearingAndLengthFirst)
{
  const Explorer explorer(oneMetre());
  TopologicalMap map;
  map.apply(NodeAdded{{NodeId{0}, {}}});
  map.apply(NodeAdded{{NodeId{1}, {{DirectionId{0}, 0.5, 1.0, DirectionState::Open, ""}}}});
  map.apply(EdgeAdded{{EdgeId{0}, NodeId{0}, NodeId{1}, 0.7, kPi, 1.2}});
  ExplorerState state;
  state.phase = ExplorerState::Phase::Homing;
  state.origin = NodeId{0};
  state.target = NodeId{0};
  state.failures[EdgeId{0}] = 1;
  auto step = explorer.next(state, map, Homed{HomingEnd::Arrived, {}});
  const auto *stride = std::get_if<DriveDirection>(&step.command);
  ASSERT_NE(stride, nullptr);
  EXPECT_DOUBLE_EQ(stride->bearing, 0.7);
  EXPECT_DOUBLE_EQ(stride->distance, 1.2);
  step = explorer.next(step.state, map, Driven{true, {0.9, 0.9, 0.7, kPi}});
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{1});
  step = explorer.next(step.state, map, Homed{HomingEnd::Arrived, {}});
  EXPECT_EQ(step.state.origin, NodeId{1});
}

TEST(Explorer, GoesRoundAWayThatFailedTwice)
{
  const Explorer explorer(oneMetre());
  TopologicalMap map;
  map.apply(NodeAdded{{NodeId{0}, {}}});
  map.apply(NodeAdded{{NodeId{1}, {{DirectionId{0}, 0.5, 1.0, DirectionState::Open, ""}}}});
  map.apply(NodeAdded{{NodeId{2}, {}}});
  map.apply(EdgeAdded{{EdgeId{0}, NodeId{0}, NodeId{1}, 0.0, kPi}});
  map.apply(EdgeAdded{{EdgeId{1}, NodeId{0}, NodeId{2}, 1.0, 1.0}});
  map.apply(EdgeAdded{{EdgeId{2}, NodeId{2}, NodeId{1}, 2.0, 2.0}});
  ExplorerState state;
  state.phase = ExplorerState::Phase::Homing;
  state.origin = NodeId{0};
  state.target = NodeId{0};
  state.failures[EdgeId{0}] = 2;
  const auto step = explorer.next(state, map, Homed{HomingEnd::Arrived, {}});
  ASSERT_TRUE(std::holds_alternative<HomeTo>(step.command));
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{2});
}

TEST(Explorer, CutOffItDrivesToAPlaceThatLeadsOn)
{
  const Explorer explorer(oneMetre());
  const CutOff at;
  auto step = explorer.next(at.state, at.map, Homed{HomingEnd::Arrived, {}});
  ASSERT_TRUE(std::holds_alternative<Recognise>(step.command));
  const Recognised seen{{{NodeId{1}, 1.0, true, 10.0}, {NodeId{0}, 0.8, false, 300.0}}};
  step = explorer.next(step.state, at.map, seen);
  ASSERT_TRUE(std::holds_alternative<HomeTo>(step.command));
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{0});
  step = explorer.next(step.state, at.map, Homed{HomingEnd::Arrived, {0.9, 0.9, 0.0, kPi}});
  EXPECT_TRUE(std::holds_alternative<DriveDirection>(step.command));
  ASSERT_EQ(step.changes.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<EdgeAdded>(step.changes[0]));
}

TEST(Explorer, DrivingToAndFroOverAShortWayStillMakesAnEdge)
{
  const Explorer explorer(oneMetre());
  const CutOff at;
  ExplorerState state = at.state;
  state.phase = ExplorerState::Phase::Returning;
  state.target = NodeId{0};
  const auto edges = [&](double straight, double travelled) {
    const Chord chord{straight, travelled, 0.0, kPi};
    const auto step = explorer.next(state, at.map, Homed{HomingEnd::Arrived, chord});
    return std::count_if(step.changes.begin(), step.changes.end(), [](const MapChange &change) {
      return std::holds_alternative<EdgeAdded>(change);
    });
  };
  EXPECT_EQ(edges(0.4, 7.0), 1);
  EXPECT_EQ(edges(0.6, 7.0), 0); // too far for a way that nobody knows
  EXPECT_EQ(edges(0.4, 9.0), 0); // odometry has drifted by then
}

TEST(Explorer, CutOffForGoodItEnds)
{
  const Explorer explorer(oneMetre());
  const CutOff at;
  auto step = explorer.next(at.state, at.map, Homed{HomingEnd::Arrived, {}});
  int looks = 0;
  for (; std::holds_alternative<Recognise>(step.command) && looks < 10; ++looks) {
    step = explorer.next(step.state, at.map, Recognised{{{NodeId{1}, 1.0, true, 10.0}}});
  }
  EXPECT_EQ(looks, ExplorerOptions{}.rescueTries);
  EXPECT_TRUE(std::holds_alternative<Finish>(step.command));
}

TEST(Explorer, APlaceHomedToInVainGivesWayToAnother)
{
  const Explorer explorer(oneMetre());
  const CutOff at;
  ExplorerState state = at.state;
  state.phase = ExplorerState::Phase::Returning;
  auto step = explorer.next(state, at.map, Homed{HomingEnd::Blocked, {}});
  ASSERT_TRUE(std::holds_alternative<Recognise>(step.command));
  const Recognised seen{{{NodeId{1}, 1.0, true, 10.0}, {NodeId{0}, 0.8, false, 300.0}}};
  step = explorer.next(step.state, at.map, seen);
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{0});
  // When nothing else is likely, the first is better than nothing.
  step = explorer.next(state, at.map, Homed{HomingEnd::Blocked, {}});
  step = explorer.next(step.state, at.map, Recognised{{{NodeId{1}, 1.0, true, 10.0}}});
  EXPECT_EQ(std::get<HomeTo>(step.command).node, NodeId{1});
}

} // namespace
} // namespace homeward
