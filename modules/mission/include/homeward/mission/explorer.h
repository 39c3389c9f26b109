// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/report.h>
#include <homeward/mission/step.h>
#include <homeward/topology/planner.h>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace homeward
{

/** Where an exploration stands; a plain value. */
struct ExplorerState
{
  /** What it waits for. */
  enum class Phase
  {
    Surveying,   ///< a new node is being made
    Driving,     ///< along a direction
    Classifying, ///< is this a known place?
    Homing,      ///< to the known place recognised after a drive
    Following,   ///< the planned route to a node with an open direction
    Striding,    ///< along a leg as it was driven once, because sight alone did not do
    Relocating,  ///< a leg of the route failed: where is this?
    Retreating,  ///< to the place left by odometry, because nothing is recognised
    Returning,   ///< to the place found by relocating
    Finished
  };

  int steps = 0;                        ///< taken so far
  Phase phase = Phase::Surveying;       ///< what it waits for
  std::optional<NodeId> origin;         ///< the node stood at last
  std::optional<DirectionId> direction; ///< of origin, being driven
  std::vector<NodeId> route;            ///< still to visit, the next first
  std::optional<NodeId> target;         ///< of the homing under way
  bool surely = false;                  ///< it is to be made sure of, whatever the ways say
  bool strode = false;                  ///< the leg under way was driven by its length already
  bool retreated = false;               ///< since the last node stood at
  double dissimilarity = 0.0;           ///< of the place recognised
  int retries = 0;                      ///< since the last node stood at
  std::map<NodeId, int> vain;           ///< homings that did not arrive since the robot last got on
  std::vector<NodeId> refuted; ///< places that this one only looked like, since the last node
  std::vector<std::pair<NodeId, NodeId>> alike; ///< two places each that only look alike
  int stranded = 0;               ///< looks for a place that leads on, since the last that did
  std::map<EdgeId, int> failures; ///< legs that were not driven to their end
  std::map<std::pair<NodeId, DirectionId>, int> attempts; ///< drives that led to no edge
  Chord chord; ///< from the origin to where the robot stands

  bool operator==(const ExplorerState &) const = default;
};

/** Settings of an exploration. */
struct ExplorerOptions
{
  double forwardDistance = 2.0; ///< metres driven along a direction before looking
  double shortestDrive = 0.6;   ///< metres; a drive blocked before is no new place
  /** Radians: an open direction this near to a driven way is settled with it; 0 is the seed's
   * behaviour. */
  double settledAngle = 0.6;
  int directionTries = 2; ///< drives without an edge after which a direction is given up
  /** Metres: a direction is closed without being driven when so near to where it leads there is a
   * node that the ways tell surely enough; 0: every direction is driven, as the seed does. */
  double closeNear = 0.0;
  int homingTries = 3;    ///< times to home to a recognised place before the way there is given up
  bool retreats = true;   ///< where nothing is recognised, drive back to the place left
  bool strides = true;    ///< drive a leg that failed by its bearing and length before homing
  bool checksWays = true; ///< an arrival far from where the ways have the place must look sure
  bool relocates = true;  ///< look for a known place where a leg failed, else make a new one there
  int legTries = 4;       ///< failures after which an edge is planned over only when cut off, ...
  int rescueTries = 3;    ///< ... as often again each time; looks then for a place that leads on
  RouteCost cost = RouteCost::ExpectedMetres; ///< of ways to an open direction; Edges: the seed's
  int maxNodes = 400; ///< a map that grows beyond is a fault, not a building

  /** Metres, one sigma, that a robot at a place may be off from where its node stands. */
  double placeSigma = 0.5;
  double surelyBeyond = 0.25; ///< metres, one sigma of the ways, beyond which sight must be sure
  double farthest = 3.0;      ///< sigmas off by the ways, beyond which it is no place however alike
  double samePlace = 0.3;     ///< metres; so near to each other there cannot be two places
  double leastLogOdds = -1.0; ///< of being at a place, to home to it; by less it is a new one, ...
  double leastNear = -2.5;    ///< ... unless the ways have the place right here: to make sure then
  double rightHere = 1.0;     ///< metres
  double nearPlace = 3.5;     ///< metres up to which the robot homes when it looks for its way

  /** Metres: what stands nearer in a direction that was open has come since, and may go again. */
  double newcomer() const { return 0.75 * forwardDistance; }

  /** Metres, by ways short enough to tell: nearer than this to a place there is no new one. */
  double crowded() const { return 0.3 * forwardDistance; }

  /** Longest way, metres, that an edge may stand for. */
  double longestEdge() const { return 2.0 * forwardDistance + 1.0; }

  /** Metres, straight, that count as a way however much the robot drove to and fro over it, ... */
  double nearEdge() const { return 0.5 * forwardDistance; }

  /** ... as long as odometry is good. */
  double longestDetour() const { return 8.0 * forwardDistance; }
};

// clang-format off
/**
 * Explores until no node has an open direction: a pure state machine over (state, map, report).
 *
 * | phase       | report     | next                                                                  |
 * |-------------|------------|-----------------------------------------------------------------------|
 * | Surveying   | Surveyed   | node, edge to the node left; then leave the node                      |
 * | Driving     | Driven     | Classifying; home to the node left when blocked at once               |
 * | Classifying | Recognised | Homing to the verified place; Surveying when there is none            |
 * | Homing      | Homed      | arrived: edge, leave the node; else Classifying anew, in the end      |
 * |             |            | Surveying where an edge can be made and no node stands by the ways or |
 * |             |            | by sure sight, else Returning to the node left                        |
 * | Following   | Homed      | arrived: next leg, leave the last node; else Relocating               |
 * | Striding    | Driven     | Following the same leg, from where it stands now                      |
 * | Relocating  | Recognised | Returning to the best place; Retreating once when there is none; then |
 * |             |            | leave the node left, if it stands right here by the ways, or else     |
 * |             |            | Surveying;                                                            |
 * |             |            | the same when cut off, but a place that leads on; else Finished       |
 * | Retreating  | Driven     | Returning to the place left                                           |
 * | Returning   | Homed      | arrived: leave the node; else Relocating                              |
 *
 * To leave a node is to drive its next open direction (Driving), else to follow the route to the
 * nearest node with one (Following), when cut off from them all to look round (Relocating), else
 * Finished. \cite Thesis, ch. 4.1
 *
 * Places look alike. What sight says of a place is weighed with where the edges on the way to it and
 * the drive from the node left have it; and where these reach round a long way, the robot makes sure
 * by sight that it has come to the place itself before there is an edge.
 */
// clang-format on
class Explorer
{
public:
  /** All that it remembers. */
  using State = ExplorerState;

  /** @throw LogicError for a distance that is not positive */
  explicit Explorer(const ExplorerOptions &options);

  /** The first step: on an empty map a survey, else resume() with nothing learnt. */
  Step<State> start(const TopologicalMap &map) const;

  /**
   * The step that follows a report. An interruption leaves the state as it was, waiting for the
   * answer to the same command. @throw LogicError when the report does not answer the phase
   */
  Step<State> next(const State &state, const TopologicalMap &map, const Report &report) const;

  /**
   * The command that a state waits for an answer to; Finish when it waits for none. So a step is
   * taken up again exactly, as long as the robot stands where it stood and its odometry goes on.
   * @throw LogicError when the state is of another map
   */
  Command pending(const State &state, const TopologicalMap &map) const;

  /**
   * The first step of an exploration that is taken up again by a robot that may stand anywhere: a
   * look at which known place this is. What was learnt of ways and directions is kept; the place
   * left and the way since are not, so that no edge can start at a place that nobody drove from.
   * Finish when nothing is left to explore.
   */
  Step<State> resume(const State &state, const TopologicalMap &map) const;

private:
  ExplorerOptions m_options;
};

} // namespace homeward
