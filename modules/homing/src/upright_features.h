// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include <vector>

namespace homeward
{

/** Blobs of a panorama, each with what surrounds it. */
struct UprightFeatures
{
  std::vector<cv::KeyPoint> points; ///< from top to bottom; size: diameter, pixels; no angle
  cv::Mat descriptors;              ///< CV_8U, a row of 128 for each
};

/**
 * Extrema of differences of Gaussians over place and scale with histograms of gradients, as SIFT
 * has them \cite Lowe2004, at a fraction of its cost: a panorama stands upright, so that features
 * need no orientation; no octave above the picture's own resolution, which is more than the
 * mirror's; gradients sampled on 16 x 16 points whatever the scale.
 * @param gray CV_8U, all round: the right edge continues at the left
 * @param contrast least difference of Gaussians, share of the range of gray levels
 * @param most the features of the strongest contrast that are kept
 */
UprightFeatures uprightFeatures(const cv::Mat &gray, double contrast, int most);

} // namespace homeward
