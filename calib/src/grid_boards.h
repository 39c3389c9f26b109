// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "point_refinement.h"

#include <homeward/calib/board_view.h>
#include <homeward/calib/mirror_circles.h>
#include <homeward/calib/target.h>

#include <optional>

namespace homeward
{

/** findBoard() for chessboards and circle grids. */
std::optional<BoardView> findGridBoard(const cv::Mat1b &picture, const Target &target,
                                       const std::optional<MirrorCircles> &mirror);

/**
 * The crossing of checkers near a guess, a ChArUco board's as far as its markers leave it alone.
 * @param toPicture as for refineSaddle()
 * @return nothing where it does not show whole
 */
std::optional<Eigen::Vector2d> refineCorner(const cv::Mat1b &picture, const Target &target,
                                            const ToPicture &toPicture);

/** A view with the points of a grid, ChArUco's corners too, refined by a camera that is known. */
BoardView refineGridPoints(const cv::Mat1b &picture, const Target &target, const BoardView &view,
                           const UnifiedCamera &camera);

/** findBoard() for boards whose markers say which is which. */
std::optional<BoardView> findMarkerBoard(const cv::Mat1b &picture, const Target &target,
                                         const std::optional<MirrorCircles> &mirror);

/** A view of an AprilTag grid with the corners refined by a camera that is known. */
BoardView refineTags(const cv::Mat1b &picture, const Target &target, const BoardView &view,
                     const UnifiedCamera &camera);

} // namespace homeward
