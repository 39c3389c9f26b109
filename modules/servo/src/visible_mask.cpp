// SPDX-License-Identifier: GPL-3.0-or-later
#include "visible_mask.h"

#include <homeward/core/error.h>

#include <string>

namespace homeward
{

cv::Mat visibleMask(const PanoramaGeometry &geometry, const cv::Mat &visible)
{
  if (visible.empty()) {
    return {geometry.height, geometry.width, CV_8UC1, cv::Scalar(255)};
  }
  if (visible.cols != geometry.width || visible.rows != geometry.height) {
    throw LogicError("mask of the panorama is " + std::to_string(visible.cols) + " x " +
                     std::to_string(visible.rows) + ", its geometry says " +
                     std::to_string(geometry.width) + " x " + std::to_string(geometry.height));
  }
  if (visible.type() != CV_8UC1) {
    throw LogicError("mask of the panorama has OpenCV type " + std::to_string(visible.type()) +
                     ", must be 8-bit gray");
  }
  return visible != 0;
}

} // namespace homeward
