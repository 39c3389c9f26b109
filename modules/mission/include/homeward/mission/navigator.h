// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/report.h>
#include <homeward/mission/step.h>

#include <map>
#include <optional>
#include <vector>

namespace homeward
{

/** Where a navigation stands; a plain value. */
struct NavigatorState
{
  enum class Phase
  {
    Locating,    ///< which known place is this?
    Approaching, ///< to the place recognised
    Following,   ///< the planned route
    Striding,    ///< along a leg as it was driven once, because sight alone did not do
    Finished
  };

  Phase phase = Phase::Locating;
  NodeId goal;
  std::optional<NodeId> here;     ///< the node stood at
  std::vector<NodeId> route;      ///< still to visit, the next first
  std::vector<NodeId> visited;    ///< stood at so far, in order
  std::map<NodeId, int> vain;     ///< approaches that did not arrive
  std::map<EdgeId, int> failures; ///< legs that were not driven to their end
  int looks = 0;                  ///< times it had to find out where it is
};

/** Settings of a navigation. */
struct NavigatorOptions
{
  int legTries = 4;      ///< failures after which an edge is never planned over again
  int approachTries = 2; ///< approaches in vain after which a place is no longer believed in
  int maxLooks = 12;     ///< times to find out anew where the robot is before it says "lost"
};

// clang-format off
/**
 * Drives to a node by sight: a pure state machine over (state, map, report). A leg that failed once is
 * driven by its bearing and length first, where the map knows both.
 *
 * | phase       | report     | next                                                                |
 * |-------------|------------|---------------------------------------------------------------------|
 * | Locating    | Recognised | Approaching the likeliest place; Finished (lost) when there is none |
 * | Approaching | Homed      | arrived: Following the shortest path; else Locating                 |
 * | Following   | Homed      | arrived: next leg, Finished at the goal; else Locating              |
 * | Striding    | Driven     | Following the same leg, from where it stands now                    |
 */
// clang-format on
class Navigator
{
public:
  using State = NavigatorState;

  explicit Navigator(const NavigatorOptions &options);

  /** The first step. @throw LogicError when the map has no node `goal` */
  Step<State> start(const TopologicalMap &map, NodeId goal) const;

  /** The step that follows a report. @throw LogicError when the report does not answer the phase */
  Step<State> next(const State &state, const TopologicalMap &map, const Report &report) const;

private:
  NavigatorOptions m_options;
};

} // namespace homeward
