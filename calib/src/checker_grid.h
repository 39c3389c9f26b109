// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace homeward
{

/** An inner corner of a chessboard and where the picture shows it. */
struct GridCorner
{
  int column = 0;
  int row = 0;
  Eigen::Vector2d pixel;
};

/** How many inner corners a board has, or a part of it. */
struct GridSize
{
  int columns = 0;
  int rows = 0;

  bool operator==(const GridSize &) const = default;
};

/**
 * The chessboard of a picture, or the largest part of it that shows: corners of checkers, joined
 * where an edge runs from one to the next, so that none is skipped. Nothing is assumed about the
 * camera but that it bends little from one corner to the next.
 *
 * Columns and rows turn from u to v in the picture. A part is counted from its own first corner:
 * nobody can tell where on the board it lies.
 * @param size of the whole board
 * @return each column and row once at most, within `size`; empty where there is no grid
 */
std::vector<GridCorner> findCheckerGrid(const cv::Mat1b &picture, const GridSize &size);

/** From the first to the last column and row that occur. */
GridSize extentOf(const std::vector<GridCorner> &grid);

} // namespace homeward
