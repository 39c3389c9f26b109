// SPDX-License-Identifier: GPL-3.0-or-later
#include "explorer_worlds.h"

#include <homeward/core/error.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

TEST(Explorer, StopsWhenInterrupted)
{
  const Explorer explorer(oneMetre());
  const auto step = explorer.next(explorer.start({}).state, {}, Interrupted{});
  EXPECT_EQ(std::get<Finish>(step.command).outcome, Outcome::Stopped);
}

TEST(Explorer, RefusesAReportThatAnswersNothing)
{
  const Explorer explorer(oneMetre());
  EXPECT_THROW(explorer.next(explorer.start({}).state, {}, Driven{}), LogicError);
  EXPECT_THROW(Explorer({.forwardDistance = 0.0}), LogicError);
}

TEST(Explorer, AStateTellsTheCommandItWaitsFor)
{
  const Explorer explorer(oneMetre());
  for (const int failures : {0, 3, 7}) {
    GridWorld world(ring(), {0, 0});
    world.homingFailures = failures;
    TopologicalMap map;
    Step<ExplorerState> step = explorer.start(map);
    std::set<ExplorerState::Phase> phases;
    while (step.state.phase != ExplorerState::Phase::Finished) {
      for (const MapChange &change : step.changes) {
        map.apply(change);
      }
      world.follow(step.changes);
      EXPECT_EQ(explorer.pending(step.state, map), step.command);
      phases.insert(step.state.phase);
      step = explorer.next(step.state, map, world.execute(step.command));
    }
    EXPECT_EQ(explorer.pending(step.state, map), step.command);
    EXPECT_GE(phases.size(), failures == 0 ? 5U : 6U);
  }
}

TEST(Explorer, InterruptedItWaitsForTheSameAnswer)
{
  const Explorer explorer(oneMetre());
  const auto step = explorer.start({});
  EXPECT_EQ(explorer.next(step.state, {}, Interrupted{}).state, step.state);
}

TEST(Explorer, ResumesByLookingWhereItIsAndKeepsWhatItLearnt)
{
  const Explorer explorer(oneMetre());
  const CutOff at;
  ExplorerState state = at.state;
  state.failures[EdgeId{0}] = 1;
  state.attempts[{NodeId{0}, DirectionId{0}}] = 1;
  state.vain[NodeId{0}] = 1;
  const auto step = explorer.resume(state, at.map);
  EXPECT_EQ(step.command, Command(Recognise{}));
  EXPECT_EQ(step.state.failures, state.failures);
  EXPECT_EQ(step.state.attempts, state.attempts);
  EXPECT_TRUE(step.state.vain.empty());
  EXPECT_EQ(explorer.start(at.map).command, Command(Recognise{}));
}

TEST(Explorer, ResumedElsewhereItMakesNoEdgeFromThePlaceItLeft)
{
  const Explorer explorer(oneMetre());
  const CutOff at;
  const Chord any{0.7, 0.7, 0.0, kPi};
  auto step = explorer.resume(at.state, at.map);
  step = explorer.next(step.state, at.map, Recognised{});
  ASSERT_EQ(step.command, Command(Survey{}));
  step = explorer.next(step.state, at.map, Surveyed{{}, any});
  ASSERT_EQ(step.changes.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<NodeAdded>(step.changes.front()));

  step = explorer.resume(at.state, at.map);
  step = explorer.next(step.state, at.map, Recognised{{{NodeId{0}, 1.0, true, 10.0}}});
  EXPECT_TRUE(std::get<HomeTo>(step.command).surely);
  step = explorer.next(step.state, at.map, Homed{HomingEnd::Arrived, any});
  EXPECT_TRUE(step.changes.empty());
  EXPECT_TRUE(std::holds_alternative<DriveDirection>(step.command));
}

TEST(Explorer, ResumedAtItsEndItEndsAtOnce)
{
  const Explorer explorer(oneMetre());
  GridWorld world(ring(), {0, 0});
  const Tour run = explore(world, oneMetre());
  EXPECT_EQ(explorer.start(run.map).command, Command(run.finish));

  // A direction that cannot be reached is not tried again.
  const CutOff at;
  ExplorerState state = at.state;
  EXPECT_TRUE(std::holds_alternative<Recognise>(explorer.resume(state, at.map).command));
  state.phase = ExplorerState::Phase::Finished;
  EXPECT_TRUE(std::holds_alternative<Finish>(explorer.resume(state, at.map).command));
}

TEST(Explorer, AStateOfAnotherMapIsRefused)
{
  const Explorer explorer(oneMetre());
  const CutOff at;
  ExplorerState state = at.state;
  state.phase = ExplorerState::Phase::Driving;
  EXPECT_THROW(explorer.pending(state, at.map), LogicError); // which direction?
  state.direction = DirectionId{4};
  EXPECT_THROW(explorer.pending(state, at.map), LogicError);
  state.origin = NodeId{7};
  EXPECT_THROW(explorer.pending(state, at.map), LogicError);
}

} // namespace
} // namespace homeward
