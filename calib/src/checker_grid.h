// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "board_grid.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace homeward
{

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
std::vector<GridPoint> findCheckerGrid(const cv::Mat1b &picture, const GridSize &size);

} // namespace homeward
