// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_grid.h"

#include <algorithm>
#include <optional>

namespace homeward
{
namespace
{

/** Takes away the outer column or row with the fewest corners. */
void dropThinnestSide(std::vector<GridPoint> &grid, bool columns)
{
  const auto place = [columns](const GridPoint &point) {
    return columns ? point.column : point.row;
  };
  const auto [low, high] =
      std::minmax_element(grid.begin(), grid.end(), [&](const GridPoint &a, const GridPoint &b) {
        return place(a) < place(b);
      });
  const int first = place(*low);
  const int last = place(*high);
  const auto count = [&](int side) {
    return std::count_if(grid.begin(), grid.end(),
                         [&](const GridPoint &point) { return place(point) == side; });
  };
  const int side = count(first) < count(last) ? first : last;
  std::erase_if(grid, [&](const GridPoint &point) { return place(point) == side; });
}

/** Counted from zero. */
void countFromZero(std::vector<GridPoint> &grid)
{
  int column = grid.front().column;
  int row = grid.front().row;
  for (const GridPoint &point : grid) {
    column = std::min(column, point.column);
    row = std::min(row, point.row);
  }
  for (GridPoint &point : grid) {
    point.column -= column;
    point.row -= row;
  }
}

/** A quarter turn; what were rows are columns. */
std::vector<GridPoint> turned(std::vector<GridPoint> grid)
{
  for (GridPoint &point : grid) {
    point = {-point.row, point.column, point.pixel};
  }
  countFromZero(grid);
  return grid;
}

/** How far to the right the columns run. */
double rightwards(const std::vector<GridPoint> &grid)
{
  double mean = 0.0;
  for (const GridPoint &point : grid) {
    mean += point.column / static_cast<double>(grid.size());
  }
  double sum = 0.0;
  for (const GridPoint &point : grid) {
    sum += (point.column - mean) * point.pixel.x();
  }
  return sum;
}

} // namespace

GridSize extentOf(const std::vector<GridPoint> &grid)
{
  if (grid.empty()) {
    return {};
  }
  const auto [left, right] =
      std::minmax_element(grid.begin(), grid.end(), [](const GridPoint &a, const GridPoint &b) {
        return a.column < b.column;
      });
  const auto [top, bottom] =
      std::minmax_element(grid.begin(), grid.end(),
                          [](const GridPoint &a, const GridPoint &b) { return a.row < b.row; });
  return {right->column - left->column + 1, bottom->row - top->row + 1};
}

std::vector<GridPoint> fitted(std::vector<GridPoint> grid, const GridSize &size)
{
  const int most = std::max(size.columns, size.rows);
  const int least = std::min(size.columns, size.rows);
  for (GridSize extent = extentOf(grid); std::max(extent.columns, extent.rows) > most ||
                                         std::min(extent.columns, extent.rows) > least;
       extent = extentOf(grid)) {
    const bool wide = extent.columns >= extent.rows;
    // The longer side shrinks while it is too long, then the shorter one.
    dropThinnestSide(grid, std::max(extent.columns, extent.rows) > most ? wide : !wide);
  }
  countFromZero(grid);
  std::optional<std::vector<GridPoint>> best;
  for (int i = 0; i < 4; ++i) {
    const GridSize extent = extentOf(grid);
    const bool fits = extent.columns <= size.columns && extent.rows <= size.rows;
    if (fits && (!best || rightwards(grid) > rightwards(*best))) {
      best = grid;
    }
    grid = turned(grid);
  }
  return best.value_or(std::vector<GridPoint>());
}

} // namespace homeward
