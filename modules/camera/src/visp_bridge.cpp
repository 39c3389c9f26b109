// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/visp_bridge.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <cstring>
#include <string>

namespace homeward
{

vpHomogeneousMatrix toVisp(const Eigen::Isometry3d &aMb)
{
  vpHomogeneousMatrix converted;
  for (unsigned int row = 0; row < 3; ++row) {
    for (unsigned int column = 0; column < 4; ++column) {
      converted[row][column] = aMb.matrix()(row, column);
    }
  }
  return converted;
}

Eigen::Isometry3d fromVisp(const vpHomogeneousMatrix &aMb)
{
  Eigen::Isometry3d converted = Eigen::Isometry3d::Identity();
  for (unsigned int row = 0; row < 3; ++row) {
    for (unsigned int column = 0; column < 4; ++column) {
      converted.matrix()(row, column) = aMb[row][column];
    }
  }
  return converted;
}

cv::Mat fromVisp(const vpImage<unsigned char> &image)
{
  const cv::Mat view(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()),
                     CV_8UC1, image.bitmap);
  return view.clone();
}

cv::Mat fromVisp(const vpImage<vpRGBa> &image)
{
  const cv::Mat view(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()),
                     CV_8UC4, image.bitmap);
  cv::Mat bgr;
  cv::cvtColor(view, bgr, cv::COLOR_RGBA2BGR);
  return bgr;
}

vpImage<unsigned char> toVispGray(const cv::Mat &image)
{
  if (image.type() != CV_8UC1) {
    throw LogicError("a gray picture is CV_8UC1, not type " + std::to_string(image.type()));
  }
  vpImage<unsigned char> copy(static_cast<unsigned int>(image.rows),
                              static_cast<unsigned int>(image.cols));
  for (int row = 0; row < image.rows; ++row) {
    std::memcpy(copy[static_cast<unsigned int>(row)], image.ptr(row),
                static_cast<std::size_t>(image.cols));
  }
  return copy;
}

vpImage<vpRGBa> toVispColour(const cv::Mat &image)
{
  if (image.type() != CV_8UC3) {
    throw LogicError("a colour picture is CV_8UC3, not type " + std::to_string(image.type()));
  }
  vpImage<vpRGBa> copy(static_cast<unsigned int>(image.rows),
                       static_cast<unsigned int>(image.cols));
  cv::Mat view(image.rows, image.cols, CV_8UC4, copy.bitmap);
  cv::cvtColor(image, view, cv::COLOR_BGR2RGBA);
  return copy;
}

} // namespace homeward
