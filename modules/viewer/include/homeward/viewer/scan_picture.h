// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/scan.h>
#include <homeward/laser/open_directions.h>

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace homeward
{

/** What a picture of a scan shows besides the scan. */
struct ScanPicture
{
  std::string title;  ///< above the picture; empty for none
  int width = 800;    ///< of the picture, pixels; the height follows
  double range = 0.0; ///< metres from the middle to the outer ring; 0 takes what the scan needs
  std::vector<OpenDirection> openDirections; ///< bearings in the scan's frame
};

/**
 * A scan as SVG, seen from above with forward on top: what it hit as dots, floor seen free in
 * white, what it did not see in gray, open directions as shaded sectors with an arrow and their
 * bearing in degrees. The same input gives the same text.
 * @throw LogicError when the width is below 200 or the range negative
 */
std::string scanSvg(const Scan &scan, const ScanPicture &picture);

/** The same as a picture, CV_8UC3 BGR. */
cv::Mat scanImage(const Scan &scan, const ScanPicture &picture);

} // namespace homeward
