// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>

#include <optional>
#include <string>
#include <variant>

namespace homeward
{

/** How a mission ended. */
enum class Outcome
{
  Done,    ///< everything asked for is done
  Stopped, ///< somebody stopped it; what was reached is kept
  Failed   ///< the reason says why it cannot go on
};

/** "done", "stopped" or "failed". */
const char *name(Outcome outcome);

/** Look around here: a panorama and the open directions of a full turn. Answer: Surveyed. */
struct Survey
{
  bool operator==(const Survey &) const = default;
};

/** Turn to a direction of the node the robot stands at and drive. Answer: Driven. */
struct DriveDirection
{
  double bearing = 0.0;  ///< radians, counter-clockwise from the node's stored heading
  double distance = 0.0; ///< metres

  bool operator==(const DriveDirection &) const = default;
};

/** Compare the view with every known place. Answer: Recognised. */
struct Recognise
{
  bool operator==(const Recognise &) const = default;
};

/** Where a node is, as the map has it. */
struct Way
{
  double bearing = 0.0;  ///< radians from the stored heading of the node stood at
  double distance = 0.0; ///< metres from there

  bool operator==(const Way &) const = default;
};

/** Drive to a node by sight. Answer: Homed. */
struct HomeTo
{
  NodeId node; ///< where to
  /** Where to look for it first: radians from the stored heading of the node stood at, if known. */
  std::optional<double> departure;
  /** Stand exactly there in the end, turned as when the node was seen. */
  bool exactly = false;
  /** Make sure that it is the node, not a place that looks alike; that is "lost". */
  bool surely = false;
  /** Come closer than a leg of a way need: where the robot stands is not known but by this. */
  bool closely = false;
  /** Seconds after which it is given up; the pilot's own when not given. */
  std::optional<double> patience = std::nullopt;
  /** Where the map has it: an arrival elsewhere counts only when the view makes sure of it. */
  std::optional<Way> way = std::nullopt;
  /** What does not let it come nearer to there for some seconds bars the way. */
  bool direct = false;
  /** It was barred from here just now: should it be so still, it does not back out first. */
  bool again = false;
  /** Having come exactly there, see what has become of the view since it was stored. */
  bool seeAnew = false;

  bool operator==(const HomeTo &) const = default;
};

/** Stand still: the mission is over. */
struct Finish
{
  Outcome outcome = Outcome::Done; ///< how the mission ended
  std::string reason;              ///< why, in words

  bool operator==(const Finish &) const = default;
};

/** What the pilot is to do next. */
using Command = std::variant<Survey, DriveDirection, Recognise, HomeTo, Finish>;

} // namespace homeward
