// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbols.h"

#include <cmath>

namespace homeward
{

Point towards(double angle)
{
  return {std::cos(angle), -std::sin(angle)};
}

void drawArrowHead(Canvas &canvas, const Point &base, double angle, double length,
                   const Style &style)
{
  const Point along = towards(angle);
  const Point aside(-along.y(), along.x());
  const Point tip = base + length * along;
  canvas.polygon({tip, base + 0.62 * length * aside, base - 0.62 * length * aside}, style);
}

void drawDirection(Canvas &canvas, const Point &centre, double angle, DirectionState state)
{
  constexpr double kLength = 7.5;
  const Point base = centre + (kNodeRadius + 3.5) * towards(angle);
  switch (state) {
  case DirectionState::Open:
    drawArrowHead(canvas, base, angle, kLength, {palette::kWhite, palette::kOpen, 1.8});
    break;
  case DirectionState::Driven:
    drawArrowHead(canvas, base, angle, kLength, {palette::kWay, palette::kWay, 1.0});
    break;
  case DirectionState::Closed:
    drawArrowHead(canvas, base, angle, kLength, {palette::kClosed, palette::kClosed, 1.0});
    break;
  }
}

LegendEntry directionEntry(DirectionState state, const std::string &words)
{
  return {16.0, words, [state](Canvas &canvas, const Point &at) {
            drawDirection(canvas, at - Point(kNodeRadius + 3.5, 0.0), 0.0, state);
          }};
}

LegendEntry lineEntry(const std::string &words, const Style &style)
{
  return {32.0, words, [style](Canvas &canvas, const Point &at) {
            canvas.line({at, at + Point(24.0, 0.0)}, style);
          }};
}

void drawNode(Canvas &canvas, const Point &centre, double heading, const std::string &label)
{
  canvas.circle(centre, kNodeRadius, {palette::kWhite, palette::kWay, 1.8});
  canvas.line({centre + (kNodeRadius + 0.5) * towards(heading),
               centre + (kNodeRadius + 4.5) * towards(heading)},
              {std::nullopt, palette::kInk, 3.0});
  if (!label.empty()) {
    const double size = label.size() < 3 ? 7.0 : 5.5;
    canvas.text(centre + Point(0.0, 0.5 * size), label, size, palette::kInk, Anchor::Middle);
  }
}

void drawRobot(Canvas &canvas, const Point &centre, double angle, double size)
{
  const Point along = 0.5 * size * towards(angle);
  const Point aside(-along.y(), along.x());
  canvas.polygon({centre + along + 0.8 * aside, centre + along - 0.8 * aside,
                  centre - along - 0.8 * aside, centre - along + 0.8 * aside},
                 {palette::kRobot, palette::kWhite, 1.5});
  drawArrowHead(canvas, centre - 0.3 * along, angle, 0.4 * size,
                {palette::kWhite, std::nullopt, 1.0});
}

} // namespace homeward
