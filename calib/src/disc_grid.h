// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "board_grid.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace homeward
{

/**
 * The grid of dark discs of a picture, or the largest part of it that shows: blobs joined where one
 * lies as those beside it foretell. Nothing is assumed about the camera but that it bends little
 * from one disc to the next.
 *
 * Columns and rows turn from u to v in the picture. A part is counted from its own first disc:
 * nobody can tell where on the board it lies.
 * @param size of the whole board
 * @return each column and row once at most, within `size`; chance may make a few blobs a grid
 */
std::vector<GridPoint> findDiscGrid(const cv::Mat1b &picture, const GridSize &size);

} // namespace homeward
