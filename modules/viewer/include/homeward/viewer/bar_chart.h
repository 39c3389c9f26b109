// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace homeward
{

/** Shares, compared. */
struct BarChart
{
  /** Bars that stand together. */
  struct Group
  {
    std::string name;           ///< below the bars
    std::vector<double> values; ///< 0 to 1, one a series
  };
  std::string title;               ///< above it
  std::vector<std::string> series; ///< named in the legend
  std::vector<Group> groups;       ///< from left to right
};

/**
 * A bar chart as SVG. The same input gives the same text.
 * @throw LogicError when a group has not one value a series, or a value is outside 0 to 1
 */
std::string barChartSvg(const BarChart &chart);

} // namespace homeward
