// SPDX-License-Identifier: GPL-3.0-or-later
#include "panorama_gray.h"

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <string>

namespace homeward
{

namespace
{

void requireSize(const char *what, const cv::Mat &picture, const PanoramaGeometry &geometry)
{
  if (picture.empty() || picture.cols != geometry.width || picture.rows != geometry.height) {
    throw LogicError(std::string(what) + " is " + std::to_string(picture.cols) + " x " +
                     std::to_string(picture.rows) + ", its geometry says " +
                     std::to_string(geometry.width) + " x " + std::to_string(geometry.height));
  }
}

} // namespace

cv::Mat grayOf(const Panorama &panorama)
{
  const cv::Mat &image = panorama.image;
  requireSize("panorama picture", image, panorama.geometry);
  if (image.type() == CV_8UC1) {
    return image;
  }
  if (image.type() != CV_8UC3) {
    throw LogicError("panorama picture has OpenCV type " + std::to_string(image.type()) +
                     ", must be 8-bit gray or BGR");
  }
  cv::Mat gray;
  cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

cv::Mat visibleMask(const PanoramaGeometry &geometry, const cv::Mat &visible)
{
  if (visible.empty()) {
    return {geometry.height, geometry.width, CV_8UC1, cv::Scalar(255)};
  }
  requireSize("mask of the panorama", visible, geometry);
  if (visible.type() != CV_8UC1) {
    throw LogicError("mask of the panorama has OpenCV type " + std::to_string(visible.type()) +
                     ", must be 8-bit gray");
  }
  return visible != 0;
}

} // namespace homeward
