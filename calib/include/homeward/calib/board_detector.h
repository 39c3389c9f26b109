// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/calib/mirror_circles.h>
#include <homeward/calib/target.h>

#include <opencv2/core/mat.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace homeward
{

/**
 * Finds a target in a mirror picture; each point is refined in the mirror picture itself. Markers
 * are found whether the picture is flipped or not.
 *
 * Of a chessboard that the rim cuts or a hand hides a part is found: at least 4 x 3 inner corners,
 * of which the first column and row that show count as the board's first. A pose takes that up.
 * @param picture CV_8UC1
 * @param mirror where to look; the whole picture without it
 * @return nothing where the target is not seen; points of the board come in the order of their ids
 * @throw LogicError for other types of picture, ConfigError as checkTarget()
 */
std::optional<BoardView> findBoard(const cv::Mat &picture, const Target &target,
                                   const std::optional<MirrorCircles> &mirror);

/**
 * findBoard() on many pictures, by several threads; the result does not depend on how many.
 * @param done called after each picture with the number of pictures done, one call at a time
 */
std::vector<std::optional<BoardView>> findBoards(const std::vector<cv::Mat> &pictures,
                                                 const Target &target,
                                                 const std::optional<MirrorCircles> &mirror,
                                                 int threads,
                                                 const std::function<void(int)> &done = {});

} // namespace homeward
