// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homeward
{

/** Shares that grow over something. */
struct LineChart
{
  /** Each point's share holds until the next point. */
  struct Series
  {
    std::string name;                    ///< in the legend
    std::vector<Eigen::Vector2d> points; ///< x, from 0 on and never falling, and share, 0 to 1
    double end = 0.0;                    ///< the line goes on to this x
  };
  std::string title;          ///< above it
  std::string xName;          ///< below the axis, with its unit
  std::vector<Series> series; ///< a line each
};

/**
 * A chart of steps as SVG. The same input gives the same text.
 * @throw LogicError for a share outside 0 to 1 or an x that is negative or falls
 */
std::string lineChartSvg(const LineChart &chart);

} // namespace homeward
