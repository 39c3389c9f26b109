// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

namespace homeward
{

/**
 * The panorama's picture in gray.
 * @throw LogicError unless it is CV_8UC1 or CV_8UC3 and of the size its geometry says
 */
cv::Mat grayPicture(const Panorama &panorama);

} // namespace homeward
