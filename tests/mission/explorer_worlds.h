// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grid_world.h"

#include <homeward/mission/explorer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace homeward
{

struct Tour
{
  TopologicalMap map;
  Finish finish;
  std::vector<std::string> log;
  int steps = 0;
};

inline Tour explore(GridWorld &world, const ExplorerOptions &options)
{
  const Explorer explorer(options);
  Tour run;
  Step<ExplorerState> step = explorer.start(run.map);
  for (; run.steps < 2000; ++run.steps) {
    for (const MapChange &change : step.changes) {
      run.map.apply(change);
    }
    world.follow(step.changes);
    run.log.insert(run.log.end(), step.log.begin(), step.log.end());
    if (const auto *finish = std::get_if<Finish>(&step.command)) {
      run.finish = *finish;
      return run;
    }
    step = explorer.next(step.state, run.map, world.execute(step.command));
  }
  ADD_FAILURE() << "the exploration does not end";
  return run;
}

//  A ring of eight places round a table, with a dead end.
inline std::vector<std::string> ring()
{
  return {"....", ".#.#", "...#"};
}

inline ExplorerOptions oneMetre()
{
  return {.forwardDistance = 1.0};
}

/** Node 0 with a direction left, node 1 that no edge leads to, and a robot that has come to 1. */
struct CutOff
{
  TopologicalMap map;
  ExplorerState state;

  CutOff()
  {
    map.apply(NodeAdded{{NodeId{0}, {{DirectionId{0}, 0.5, 1.0, DirectionState::Open, ""}}}});
    map.apply(NodeAdded{{NodeId{1}, {}}});
    state.phase = ExplorerState::Phase::Homing;
    state.origin = NodeId{1};
    state.target = NodeId{1};
  }
};

/** One place with one open direction, along which the robot is to drive. */
struct AtTheFirstPlace
{
  TopologicalMap map;
  Step<ExplorerState> step;

  explicit AtTheFirstPlace(const Explorer &explorer) : step(explorer.start(map))
  {
    step = explorer.next(step.state, map, Surveyed{{{0.0, 1.0, 3.0}}, {}});
    for (const MapChange &change : step.changes) {
      map.apply(change);
    }
  }
};

//  0 - 1 - 2, a metre apart; the robot has driven half a metre on from 2.
struct Row
{
  TopologicalMap map;
  ExplorerState state;
  Driven report{false, {0.5, 0.5, 0.0, kPi}};

  Row()
  {
    for (int i = 0; i < 3; ++i) {
      map.apply(NodeAdded{{NodeId{i}, {}}});
    }
    for (int i = 0; i < 2; ++i) {
      map.apply(EdgeAdded{{EdgeId{i}, NodeId{i}, NodeId{i + 1}, 0.0, kPi, 1.0}});
    }
    state.phase = ExplorerState::Phase::Driving;
    state.origin = NodeId{2};
  }

  Command whenSeen(const PlaceMatch &match) const
  {
    const Explorer explorer(oneMetre());
    const auto step = explorer.next(state, map, report);
    return explorer.next(step.state, map, Recognised{{match}}).command;
  }
};

} // namespace homeward
