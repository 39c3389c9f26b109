// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>
#include <homeward/laser/open_directions.h>

#include <limits>
#include <optional>
#include <variant>
#include <vector>

namespace homeward
{

/** The way since the node the robot stood at last, by odometry; good over a few metres only. */
struct Chord
{
  double distance = 0.0;        ///< straight, metres
  double travelled = 0.0;       ///< along the path driven, metres
  double bearingAtOrigin = 0.0; ///< radians from the stored heading of the node left
  double bearingAtHere = 0.0;   ///< back to it; radians from the heading of the place reached

  bool operator==(const Chord &) const = default;
};

/** One known place that the view may show. */
struct PlaceMatch
{
  NodeId node;                ///< that it may be
  double probability = 0.0;   ///< that the view was taken within a metre of the node, 0 to 1
  bool verified = false;      ///< sure enough to act on
  double dissimilarity = 0.0; ///< of the gray histograms, on the scale of the seed's thresholds
};

/** Answer to Survey. */
struct Surveyed
{
  std::vector<OpenDirection> directions; ///< bearings from the robot's heading when it looked
  Chord chord;                           ///< from the node left
};

/** Answer to DriveDirection. */
struct Driven
{
  bool blocked = false; ///< stopped by something before the distance was reached
  Chord chord;          ///< from the node left
  /** Metres that the laser sees straight on from where it was blocked. */
  double seenAhead = std::numeric_limits<double>::infinity();
};

/** Answer to Recognise. */
struct Recognised
{
  std::vector<PlaceMatch> matches; ///< best first
};

/** How a homing ended. */
enum class HomingEnd
{
  Arrived,
  Lost,    ///< the views no longer tell the way
  Blocked, ///< no free way towards it
  TimedOut
};

/** As people read it: "arrived", "timed out". */
const char *name(HomingEnd end);

/** What the view from a place says of the picture that is stored of it. */
struct SeenAnew
{
  double sure = 0.0;      ///< probability that it is the place, not one that looks alike
  bool likeliest = false; ///< no other known place is likelier
  double change = 0.0;    ///< how much the edges differ, 0 (not at all) to 1
};

/** Answer to HomeTo. */
struct Homed
{
  HomingEnd end = HomingEnd::Lost; ///< why it ended
  Chord chord;                     ///< from the node left
  double seconds = 0.0;            ///< it took, by the robot's clock
  double time = 0.0;               ///< when it ended, seconds, by the robot's clock
  /** Of HomeTo::seeAnew, when sight says that the robot stands within centimetres of the place. */
  std::optional<SeenAnew> seen = std::nullopt;
};

/** Somebody asked the robot to stop; it stands. */
struct Interrupted
{};

/** What the pilot says when a command has ended. Never an image. */
using Report = std::variant<Surveyed, Driven, Recognised, Homed, Interrupted>;

} // namespace homeward
