// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace homeward
{

/** Pixels along an edge, in order. */
using EdgeChain = std::vector<Eigen::Vector2d>;

/**
 * Smooth edges of a gray picture where the mask is set, to a fraction of a pixel.
 * @param shortest chains with fewer pixels are left out
 */
std::vector<EdgeChain> findEdgeChains(const cv::Mat1b &picture, const cv::Mat &mask, int shortest);

} // namespace homeward
