// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <array>
#include <functional>
#include <optional>

namespace homeward
{

/** From the board to the picture, pixels. What it is given in says who takes it. */
using ToPicture = std::function<Eigen::Vector2d(const Eigen::Vector2d &)>;

/**
 * The crossing of a chessboard's edges.
 * @param toPicture from pitches right and down of the guess; roughly
 * @param reach how far the edges run on undisturbed, pitches
 * @return nothing where no edges cross near the guess
 */
std::optional<Eigen::Vector2d> refineSaddle(const cv::Mat1b &picture, const ToPicture &toPicture,
                                            double reach);

/**
 * Whether the four checkers round a corner show as far as refineSaddle() looks: those across from
 * each other are alike, which the mirror's rim or a hand in front of one of them spoils.
 * @param toPicture as for refineSaddle()
 */
bool showsWholeCheckers(const cv::Mat1b &picture, const ToPicture &toPicture);

/**
 * The middle of a dark disc half a pitch wide.
 * @param toPicture from pitches right and down of the guess; roughly
 * @return nothing where there is none near the guess
 */
std::optional<Eigen::Vector2d> refineDisc(const cv::Mat1b &picture, const ToPicture &toPicture);

/**
 * The corners of a dark square by straight lines through its four edges.
 * @param toPicture from the square's own frame, corners (0, 0) to (1, 1), to the picture; roughly
 * @return clockwise from (0, 0); nothing where an edge does not show
 */
std::optional<std::array<Eigen::Vector2d, 4>> refineSquare(const cv::Mat1b &picture,
                                                           const ToPicture &toPicture);

} // namespace homeward
