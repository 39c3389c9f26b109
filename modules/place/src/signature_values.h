// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/place/signature.h>

#include <opencv2/core/mat.hpp>

#include <vector>

namespace homeward
{

/** Counts of the 256 gray levels. @param gray CV_8UC1 */
std::vector<float> grayHistogram(const cv::Mat &gray);

/** Counts of 32 gray levels by band of rows, the top band first. @param gray CV_8UC1 */
std::vector<float> bandHistograms(const cv::Mat &gray);

/** Counts by hue, saturation and value. @param bgr CV_8UC3 */
std::vector<float> hsvHistogram(const cv::Mat &bgr);

/** Counts by red-green and yellow-blue, relative to brightness, and brightness. @param bgr CV_8UC3
 */
std::vector<float> opponentHistogram(const cv::Mat &bgr);

/** Magnitudes of 30 frequencies, by row and frequency. @param gray CV_8UC1 */
std::vector<float> fourierMagnitudes(const cv::Mat &gray);

/** The same of edges, summed over bands of 8 rows of length 1 each. @param gray CV_8UC1 */
std::vector<float> edgeMagnitudes(const cv::Mat &gray);

/** The same of edges in 16 bands x 16 frequencies, whole numbers 0 to 255. @param gray CV_8UC1 */
std::vector<float> edgeBytes(const cv::Mat &gray);

/**
 * Spectra of the rising and of the falling edges of 16 bands, all bands of length 1, columns of the
 * panorama too: for turnCorrelationDistance(). @param gray CV_8UC1
 */
std::vector<float> alignedEdges(const cv::Mat &gray);

/** What stands for zero in alignedBytes(). */
inline constexpr float kZeroByte = 128.0F;

/** alignedEdges() in whole numbers, 0 to 255. @param gray CV_8UC1 */
std::vector<float> alignedBytes(const cv::Mat &gray);

/** What the distance of two vectors of values is divided by to be a dissimilarity. */
double dissimilarityUnit(const Signature &signature);

} // namespace homeward
