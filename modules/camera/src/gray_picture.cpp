// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/gray_picture.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <string>

namespace homeward
{

cv::Mat grayPicture(const Panorama &panorama)
{
  const cv::Mat &image = panorama.image;
  const PanoramaGeometry &geometry = panorama.geometry;
  if (image.empty() || image.cols != geometry.width || image.rows != geometry.height) {
    throw LogicError("panorama picture is " + std::to_string(image.cols) + " x " +
                     std::to_string(image.rows) + ", its geometry says " +
                     std::to_string(geometry.width) + " x " + std::to_string(geometry.height));
  }
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

} // namespace homeward
