// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace homeward
{

/** A point of a board's grid and where the picture shows it. */
struct GridPoint
{
  int column = 0;
  int row = 0;
  Eigen::Vector2d pixel;
};

/** How many points a board has, or a part of it. */
struct GridSize
{
  int columns = 0;
  int rows = 0;

  bool operator==(const GridSize &) const = default;

  /** Of a point, row by row. */
  std::size_t index(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }

  std::size_t points() const
  {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

/** From the first to the last column and row that occur. */
GridSize extentOf(const std::vector<GridPoint> &grid);

/**
 * The grid without the sides that are too much for the board, counted from zero, turned so that it
 * fits and reads rightwards as far as it can; empty where no turn fits.
 */
std::vector<GridPoint> fitted(std::vector<GridPoint> grid, const GridSize &size);

} // namespace homeward
