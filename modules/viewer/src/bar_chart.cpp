// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/bar_chart.h>

#include "chart_parts.h"

#include <homeward/core/error.h>

#include <algorithm>

namespace homeward
{

namespace
{

constexpr double kBar = 14.0; // pixels
constexpr double kGap = 30.0;
constexpr double kLeft = 60.0;
constexpr double kTop = 50.0;
constexpr double kHeight = 300.0;
constexpr double kLegendLine = 20.0;
constexpr double kText = 10.0;

void rectangle(Canvas &canvas, const Point &corner, const Point &size, Colour colour)
{
  canvas.polygon(
      {corner, corner + Point(size.x(), 0.0), corner + size, corner + Point(0.0, size.y())},
      {.fill = colour});
}

void check(const BarChart &chart)
{
  for (const BarChart::Group &group : chart.groups) {
    if (group.values.size() != chart.series.size()) {
      throw LogicError("group '" + group.name + "' has " + std::to_string(group.values.size()) +
                       " values for " + std::to_string(chart.series.size()) + " series");
    }
    for (const double value : group.values) {
      if (!(value >= 0.0 && value <= 1.0)) {
        throw LogicError("a bar of " + std::to_string(value) + " is not a share, 0 to 1");
      }
    }
  }
}

} // namespace

std::string barChartSvg(const BarChart &chart)
{
  check(chart);
  const double groupWidth =
      kBar * static_cast<double>(std::max<std::size_t>(8, chart.series.size()));
  const double width =
      kLeft + (groupWidth + kGap) * static_cast<double>(chart.groups.size()) + kGap;
  const double legend = kTop + kHeight + 50.0;
  SvgCanvas canvas(
      static_cast<int>(width),
      static_cast<int>(legend + kLegendLine * static_cast<double>(chart.series.size())));
  canvas.text({kLeft, 28.0}, chart.title, 14.0, kChartInk, Anchor::Left);
  drawShareScale(canvas, kLeft, width - kGap / 2.0, kTop, kHeight);
  double x = kLeft + kGap / 2.0;
  for (const BarChart::Group &group : chart.groups) {
    for (std::size_t i = 0; i < group.values.size(); ++i) {
      const double height = kHeight * group.values[i];
      rectangle(canvas, {x + kBar * static_cast<double>(i), kTop + kHeight - height},
                {kBar - 2.0, height}, seriesColour(i));
    }
    canvas.text({x + groupWidth / 2.0, kTop + kHeight + 20.0}, group.name, kText, kChartInk,
                Anchor::Middle);
    x += groupWidth + kGap;
  }
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const double y = legend + kLegendLine * static_cast<double>(i);
    rectangle(canvas, {kLeft, y - kText}, {kText, kText}, seriesColour(i));
    canvas.text({kLeft + 18.0, y}, chart.series[i], kText, kChartInk, Anchor::Left);
  }
  return canvas.svg();
}

} // namespace homeward
