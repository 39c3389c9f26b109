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

/** findBoard() for boards whose markers say which is which. */
std::optional<BoardView> findMarkerBoard(const cv::Mat1b &picture, const Target &target,
                                         const std::optional<MirrorCircles> &mirror);

} // namespace homeward
