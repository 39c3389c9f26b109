// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace homeward
{

/** What became of a way to leave a place. */
enum class DirectionState
{
  Open,   ///< nobody has driven there yet
  Driven, ///< an edge leaves that way, or the robot came from there
  Closed  ///< given up; Direction::reason says why
};

/** "open", "driven" or "closed". */
std::string_view name(DirectionState state);

/** Inverse of name(); nothing for any other word. */
std::optional<DirectionState> parseDirectionState(std::string_view word);

/** A way to leave a place. */
struct Direction
{
  DirectionId id;       ///< its index in Node::directions
  double bearing = 0.0; ///< radians, ccw from the robot's heading when the node was created
  double width = 0.0;   ///< radians, 0 or more
  DirectionState state = DirectionState::Open; ///< what became of it
  std::string reason = {};                     ///< why it was settled; empty while open

  bool operator==(const Direction &) const = default;
};

/** A place. */
struct Node
{
  NodeId id;                              ///< its name for the map
  std::vector<Direction> directions = {}; ///< ways to leave it, by id
  /** What people call it; empty: nothing. No other node has it, and it is never all digits, so that
   * it cannot be taken for a number. */
  std::string name = {};

  bool operator==(const Node &) const = default;
};

/** What came of driving along an edge, both ways together. */
struct EdgeStatistics
{
  int tries = 0;              ///< both ways together
  int successes = 0;          ///< tries at most
  double meanSeconds = 0.0;   ///< of successes, robot time; 0 without any
  std::string lastError = {}; ///< what the last failure ended with; empty: there was none
  double lastTime = 0.0;      ///< of the last try, seconds, by the clock of who tried

  bool operator==(const EdgeStatistics &) const = default;
};

/** Two places with a driven way between them, usable both ways. */
struct Edge
{
  EdgeId id; ///< its name for the map
  NodeId a;  ///< one end
  NodeId b;  ///< the other end
  /** Departure bearing towards the other end, radians ccw from that node's stored heading. */
  std::optional<double> bearingAtA = std::nullopt;
  std::optional<double> bearingAtB = std::nullopt; ///< as bearingAtA, at b towards a
  std::optional<double> length = std::nullopt;     ///< metres, straight, as odometry had it
  EdgeStatistics statistics = {};                  ///< of drives along it
  bool forbidden = false;                          ///< no-go: never planned over

  bool operator==(const Edge &) const = default;
};

/**
 * The metres one must expect to drive along an edge until it is behind the robot: its length (2 m
 * where that is unknown, 0.1 m at least) times the tries it takes,
 *
 *     (tries + 1) / (successes + 1),
 *
 * 1000 km at most.
 */
double expectedMetres(const Edge &edge);

/** A place is added; its id is TopologicalMap::nextNodeId(), its directions' ids count from 0. */
struct NodeAdded
{
  Node node; ///< the new place
};

/** A way is added; its id is TopologicalMap::nextEdgeId(). */
struct EdgeAdded
{
  Edge edge; ///< the new way
};

/** An open direction becomes driven or closed, once and for good. */
struct DirectionSettled
{
  NodeId node;                                   ///< whose direction
  DirectionId direction;                         ///< that becomes settled
  DirectionState state = DirectionState::Closed; ///< driven or closed
  std::string reason = {};                       ///< why
};

/** A place gets a name, or loses it when that is empty. */
struct NodeNamed
{
  NodeId node;           ///< which
  std::string name = {}; ///< what people call it now
};

/** A place is gone, and its edges with it. */
struct NodeRemoved
{
  NodeId node; ///< which
};

/** A way is gone. */
struct EdgeRemoved
{
  EdgeId edge; ///< which
};

/** A way must not, or may again, be driven. */
struct EdgeForbidden
{
  EdgeId edge;           ///< which
  bool forbidden = true; ///< or allowed again
};

/** Somebody tried to drive along an edge. */
struct EdgeTried
{
  EdgeId edge;          ///< which
  std::string end = {}; ///< empty: arrived; else the word for what went wrong
  double seconds = 0.0; ///< it took, 0 or more
  double time = 0.0;    ///< when it ended, seconds; EdgeStatistics::lastTime
};

/**
 * `gone` is the same place as `kept`, seen with the heading turned by `turn`:
 *
 *     bearing in kept = bearing in gone + turn
 *
 * Edges of `gone` become edges of `kept` with their ids, bearings turned; an open direction of
 * `kept` within kTakenOver of one becomes driven. An edge between the two disappears. Where both
 * had an edge to a third place that of `kept` stays, with the statistics of both, forbidden if
 * either was. The directions of `gone` are dropped. Its name is kept where `kept` has none.
 */
struct NodesMerged
{
  NodeId kept;       ///< whose id stays
  NodeId gone;       ///< whose id is never used again
  double turn = 0.0; ///< radians ccw
};

/** How near an edge that is taken over must leave to settle an open direction, radians. */
inline constexpr double kTakenOver = 0.6;

/** One step in the life of a map. */
using MapChange = std::variant<NodeAdded, EdgeAdded, DirectionSettled, NodeNamed, NodeRemoved,
                               EdgeRemoved, EdgeForbidden, EdgeTried, NodesMerged>;

} // namespace homeward
