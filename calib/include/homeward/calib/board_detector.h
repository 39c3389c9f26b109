// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/calib/mirror_circles.h>
#include <homeward/calib/target.h>
#include <homeward/camera/camera_model.h>

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
 * Of a chessboard or a circle grid that the rim cuts or a hand hides a part is found: at least 4 x
 * 3 points, of which the first column and row that show count as the board's first. A pose takes
 * that up.
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

/**
 * The points once more, with a camera that is known better than findBoard() could guess it: how it
 * bends a point's surroundings tells where the point is, to a hundredth of a pixel. Calibrate,
 * refine, calibrate again. \cite Datta2009
 * @param pictures CV_8UC1, one a view
 * @param camera a unified model, such as calibrate() finds
 * @throw LogicError for other types of picture, for other models, unless there is a picture a view
 */
BoardViews refineBoards(const std::vector<cv::Mat> &pictures, const Target &target,
                        const BoardViews &views, const CameraModel &camera);

} // namespace homeward
