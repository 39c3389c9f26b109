// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/report.h>
#include <homeward/mission/step.h>
#include <homeward/topology/planner.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace homeward
{

/** Where a navigation stands; a plain value. */
struct NavigatorState
{
  /** What it waits for. */
  enum class Phase
  {
    Locating,    ///< which known place is this?
    Approaching, ///< to the place recognised
    Surveying,   ///< nothing is recognised here: which ways are open?
    Searching,   ///< along one of them, to look again elsewhere
    Following,   ///< the planned route
    Returning,   ///< to the node left, before anything else
    Striding,    ///< along a leg as it was driven once, because sight alone did not do
    Finished
  };

  Phase phase = Phase::Locating;  ///< what it waits for
  NodeId goal;                    ///< where to
  std::optional<NodeId> here;     ///< the node stood at last
  std::vector<NodeId> route;      ///< still to visit, the next first
  std::vector<NodeId> visited;    ///< stood at so far, in order
  std::map<NodeId, int> vain;     ///< how much approaches that did not arrive speak against a place
  std::map<EdgeId, int> failures; ///< legs that were not driven to their end
  std::set<EdgeId> blocked;       ///< of these, those that something bars
  bool lastTry = false;           ///< of what is blocked, since there is no way round
  int looks = 0;                  ///< times it had to find out where it is
  /** To search along, the next first: radians from the heading at the last survey. */
  std::vector<double> ways;
  bool surveyed = false; ///< since it stood at a place
};

/** When the picture of a place gives way to a newer one. */
struct RefreshOptions
{
  bool wanted = false;       ///< pictures are refreshed at all
  double leastSure = 0.99;   ///< probability of standing at the place
  double leastChange = 0.15; ///< SeenAnew::change of views that one in the same light never has
  double farthest = 0.6;     ///< metres from where the way says, beyond which it is another place
};

/** Settings of a navigation. */
struct NavigatorOptions
{
  RouteCost cost = RouteCost::ExpectedMetres; ///< of a way
  int legTries = 4;  ///< failures after which an edge is never planned over again
  int maxLooks = 16; ///< times to find out anew where the robot is before it says "lost"
  double leastProbability = 0.2; ///< of a place, to drive there and make sure of it
  double vainFactor = 0.3;       ///< by which an approach in vain makes a place less probable
  double approachSeconds = 25.0; ///< after which an approach is given up
  double searchDistance = 0.8;   ///< metres driven before looking again
  double shortestSearch = 0.3;   ///< metres; the view from nearer by is the same
  RefreshOptions refresh = {};   ///< of the pictures of goals
};

// clang-format off
/**
 * Drives to a node by sight: a pure state machine over (state, map, report). A leg that failed once is
 * driven by its bearing and length first, where the map knows both. A leg that something bars is left
 * out of every plan of this drive; where nothing else leads on it is tried once more, for a moment
 * only from where it was just barred, and then it is barred however that ends.
 *
 * | phase       | report     | next                                                                |
 * |-------------|------------|---------------------------------------------------------------------|
 * | Locating    | Recognised | Approaching the likeliest place; when there is none Searching       |
 * |             |            | straight on, Surveying at first; Finished (lost) after many looks   |
 * | Approaching | Homed      | arrived: Following the shortest path; else Locating                 |
 * | Surveying   | Surveyed   | Searching along the most open way; Finished (lost) when none is     |
 * | Searching   | Driven     | Locating; blocked at once: Searching along the next way             |
 * | Following   | Homed      | arrived: next leg, Finished at the goal; barred: Returning, to go   |
 * |             |            | another way, Following once more when there is none, then Finished  |
 * |             |            | (unreachable); else Locating                                        |
 * | Returning   | Homed      | arrived: Following the shortest path; else Locating                 |
 * | Striding    | Driven     | Following the same leg, from where it stands now                    |
 *
 * Places look alike, and from a metre away the right one does not look sure. So an unlikely place is
 * driven to as well, and it is believed in when sight there makes sure of it. Only of the node left
 * and its neighbours it need not: the ways say already that the robot can be there.
 *
 * Where it is wanted, a goal gets a new picture when the old one no longer shows the place as it is:
 * the robot has come along an edge to where the map has the goal, sight is sure that it is the goal
 * and no other place, and yet the views differ.
 */
// clang-format on
class Navigator
{
public:
  /** All that it remembers. */
  using State = NavigatorState;

  /** @param options hold for every goal */
  explicit Navigator(const NavigatorOptions &options);

  /**
   * The first step.
   * @param left the node stood at last and not far from, as an earlier drive knows it
   * @throw LogicError when the map has no such node
   */
  Step<State> start(const TopologicalMap &map, NodeId goal,
                    std::optional<NodeId> left = std::nullopt) const;

  /** The step that follows a report. @throw LogicError when the report does not answer the phase */
  Step<State> next(const State &state, const TopologicalMap &map, const Report &report) const;

private:
  NavigatorOptions m_options;
};

} // namespace homeward
