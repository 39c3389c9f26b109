// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_parts.h"

#include <array>

namespace homeward
{
namespace
{

constexpr std::array<Colour, 12> kColours{{{78, 121, 167},
                                           {242, 142, 43},
                                           {225, 87, 89},
                                           {118, 183, 178},
                                           {89, 161, 79},
                                           {237, 201, 72},
                                           {176, 122, 161},
                                           {255, 157, 167},
                                           {156, 117, 95},
                                           {186, 176, 172},
                                           {30, 60, 120},
                                           {120, 30, 60}}};

} // namespace

Colour seriesColour(std::size_t series)
{
  return kColours[series % kColours.size()];
}

void drawShareScale(Canvas &canvas, double left, double right, double top, double height)
{
  constexpr double kText = 10.0;
  for (int percent = 0; percent <= 100; percent += 20) {
    const double y = top + height * (1.0 - percent / 100.0);
    canvas.line({{left, y}, {right, y}}, {.stroke = kChartRule});
    canvas.text({left - 8.0, y + kText / 2.0}, std::to_string(percent) + " %", kText, kChartInk,
                Anchor::Right);
  }
}

} // namespace homeward
