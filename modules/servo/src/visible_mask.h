// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

namespace homeward
{

/**
 * CV_8UC1, 255 where `visible` is not zero, everywhere when it is empty.
 * @throw LogicError unless it is CV_8UC1 and of the geometry's size
 */
cv::Mat visibleMask(const PanoramaGeometry &geometry, const cv::Mat &visible);

} // namespace homeward
