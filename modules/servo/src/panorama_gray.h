// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

namespace homeward
{

/**
 * The panorama's picture in gray, CV_8UC1.
 * @throw LogicError unless it is CV_8UC1 or CV_8UC3 and of the size its geometry says
 */
cv::Mat grayOf(const Panorama &panorama);

/**
 * CV_8UC1, 255 where `visible` is not zero, everywhere when it is empty.
 * @throw LogicError unless it is CV_8UC1 and of the geometry's size
 */
cv::Mat visibleMask(const PanoramaGeometry &geometry, const cv::Mat &visible);

} // namespace homeward
