// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/line_chart.h>

#include "chart_parts.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

constexpr double kLeft = 60.0; // pixels
constexpr double kTop = 50.0;
constexpr double kWidth = 640.0;
constexpr double kHeight = 300.0;
constexpr double kMargin = 20.0;
constexpr double kLegendLine = 20.0;
constexpr double kText = 10.0;

void check(const LineChart &chart)
{
  for (const LineChart::Series &series : chart.series) {
    double before = 0.0;
    for (const Eigen::Vector2d &point : series.points) {
      if (!(point.y() >= 0.0 && point.y() <= 1.0)) {
        throw LogicError("a point of " + std::to_string(point.y()) + " is not a share, 0 to 1");
      }
      if (!(point.x() >= before)) {
        throw LogicError("series '" + series.name + "' falls back to " + std::to_string(point.x()));
      }
      before = point.x();
    }
  }
}

double endOf(const LineChart::Series &series)
{
  return series.points.empty() ? series.end : std::max(series.end, series.points.back().x());
}

/** A round step that makes five to ten parts of a length. */
double roundStep(double length)
{
  const double power = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (length / (factor * power) <= 10.0) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

std::vector<Point> steps(const LineChart::Series &series, double scale)
{
  const auto at = [&](double x, double share) {
    return Point(kLeft + scale * x, kTop + kHeight * (1.0 - share));
  };
  std::vector<Point> line;
  double share = 0.0;
  for (const Eigen::Vector2d &point : series.points) {
    line.push_back(at(point.x(), share));
    line.push_back(at(point.x(), point.y()));
    share = point.y();
  }
  line.push_back(at(endOf(series), share));
  return line;
}

} // namespace

std::string lineChartSvg(const LineChart &chart)
{
  check(chart);
  double longest = 10.0; // the labels of the axis are whole numbers
  for (const LineChart::Series &series : chart.series) {
    longest = std::max(longest, endOf(series));
  }
  const double step = roundStep(longest);
  const double scale = kWidth / (step * std::ceil(longest / step));
  const double legend = kTop + kHeight + 60.0;
  SvgCanvas canvas(
      static_cast<int>(kLeft + kWidth + kMargin),
      static_cast<int>(legend + kLegendLine * static_cast<double>(chart.series.size())));
  canvas.text({kLeft, 28.0}, chart.title, 14.0, kChartInk, Anchor::Left);
  drawShareScale(canvas, kLeft, kLeft + kWidth, kTop, kHeight);
  for (int i = 0; scale * step * i <= kWidth + 0.5; ++i) {
    const double x = kLeft + scale * step * i;
    canvas.line({{x, kTop + kHeight}, {x, kTop + kHeight + 5.0}}, {.stroke = kChartInk});
    canvas.text({x, kTop + kHeight + 18.0}, std::to_string(std::lround(step * i)), kText, kChartInk,
                Anchor::Middle);
  }
  canvas.text({kLeft + kWidth / 2.0, kTop + kHeight + 38.0}, chart.xName, kText, kChartInk,
              Anchor::Middle);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const LineChart::Series &series = chart.series[i];
    const double y = legend + kLegendLine * static_cast<double>(i);
    canvas.line(steps(series, scale), {.stroke = seriesColour(i), .width = 2.0});
    canvas.line({{kLeft, y - kText / 2.0}, {kLeft + 14.0, y - kText / 2.0}},
                {.stroke = seriesColour(i), .width = 2.0});
    canvas.text({kLeft + 20.0, y}, series.name, kText, kChartInk, Anchor::Left);
  }
  return canvas.svg();
}

} // namespace homeward
