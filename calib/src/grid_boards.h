// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/calib/mirror_circles.h>
#include <homeward/calib/target.h>

#include <optional>

namespace homeward
{

/** findBoard() for chessboards and circle grids. */
std::optional<BoardView> findGridBoard(const cv::Mat1b &picture, const Target &target,
                                       const std::optional<MirrorCircles> &mirror);

/** How far a ChArUco corner looks the same from both sides: to a marker's first cells; pitches. */
double undisturbedReach(const Target &target);

/** A view with the points of a grid, ChArUco's corners too, refined by a camera that is known. */
BoardView refineGridPoints(const cv::Mat1b &picture, const Target &target, const BoardView &view,
                           const UnifiedCamera &camera);

/** findBoard() for boards whose markers say which is which. */
std::optional<BoardView> findMarkerBoard(const cv::Mat1b &picture, const Target &target,
                                         const std::optional<MirrorCircles> &mirror);

} // namespace homeward
