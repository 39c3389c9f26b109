// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "legend.h"

#include <homeward/topology/map.h>

namespace homeward
{

/** The colours of all pictures. */
namespace palette
{
inline constexpr Colour kInk{38, 50, 56};
inline constexpr Colour kFaint{120, 134, 142};
inline constexpr Colour kGrid{214, 220, 224};
inline constexpr Colour kWhite{255, 255, 255};
inline constexpr Colour kFloor{236, 239, 241};
inline constexpr Colour kObstacle{69, 82, 90};
inline constexpr Colour kWay{21, 101, 192};
inline constexpr Colour kPath{128, 196, 184};
inline constexpr Colour kOpen{230, 81, 0};
inline constexpr Colour kOpenShade{255, 224, 196};
inline constexpr Colour kClosed{158, 158, 158};
inline constexpr Colour kRoute{194, 24, 91};
inline constexpr Colour kRobot{194, 24, 91};
} // namespace palette

/** Radius of a place, pixels. */
inline constexpr double kNodeRadius = 10.5;

/** Unit vector on the canvas of an angle counter-clockwise from x, radians. */
Point towards(double angle);

/** An arrow head whose base is at `base`, pointing along `angle` (radians, ccw, y up). */
void drawArrowHead(Canvas &canvas, const Point &base, double angle, double length,
                   const Style &style);

/** The arrow of a direction in its state, outside a place at `centre`. */
void drawDirection(Canvas &canvas, const Point &centre, double angle, DirectionState state);

/** What the arrow of a direction in its state means. */
LegendEntry directionEntry(DirectionState state, const std::string &words);

/** What a line means. */
LegendEntry lineEntry(const std::string &words, const Style &style);

/** A place: disc with number, and a tick along its heading. Nothing is written for an empty label.
 */
void drawNode(Canvas &canvas, const Point &centre, double heading, const std::string &label);

/** A robot of `size` pixels, pointing along `angle`. */
void drawRobot(Canvas &canvas, const Point &centre, double angle, double size);

} // namespace homeward
