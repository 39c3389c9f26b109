// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

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
 * @return nothing where no edges cross near the guess, or something hides a part of a checker
 */
std::optional<Eigen::Vector2d> refineSaddle(const cv::Mat1b &picture, const ToPicture &toPicture,
                                            double reach);

/**
 * The middle of a dark disc half a pitch wide.
 * @param toPicture from pitches right and down of the guess; roughly
 * @return nothing where there is none near the guess
 */
std::optional<Eigen::Vector2d> refineDisc(const cv::Mat1b &picture, const ToPicture &toPicture);

} // namespace homeward
