// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/store/view_codec.h>

#include <opencv2/imgcodecs.hpp>

#include <string>

namespace homeward
{

namespace
{

constexpr int kJpegQuality = 90;

std::string sizeText(int width, int height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

bool fits(const cv::Mat &image, const PanoramaGeometry &geometry)
{
  return image.cols == geometry.width && image.rows == geometry.height;
}

} // namespace

ViewBytes encodeView(const Panorama &panorama)
{
  const cv::Mat &image = panorama.image;
  if (image.empty() || !fits(image, panorama.geometry)) {
    throw LogicError("view: picture of " + sizeText(image.cols, image.rows) +
                     " pixels in a panorama of " +
                     sizeText(panorama.geometry.width, panorama.geometry.height));
  }
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3) {
    throw LogicError("view: picture of type " + cv::typeToString(image.type()) +
                     ", CV_8UC1 or CV_8UC3 is needed");
  }
  ViewBytes bytes;
  if (!cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality})) {
    throw RuntimeError("view: OpenCV cannot write JPEG; install it with JPEG support");
  }
  return bytes;
}

Panorama decodeView(const ViewBytes &bytes, const PanoramaGeometry &geometry)
{
  cv::Mat image;
  if (!bytes.empty()) {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  }
  if (image.empty()) {
    throw RuntimeError("view: " + std::to_string(bytes.size()) + " bytes that are no picture");
  }
  if (!fits(image, geometry) || (image.type() != CV_8UC1 && image.type() != CV_8UC3)) {
    throw RuntimeError("view: picture of " + sizeText(image.cols, image.rows) + " pixels, type " +
                       cv::typeToString(image.type()) + ", where the map's panoramas have " +
                       sizeText(geometry.width, geometry.height) + " of 8 bits");
  }
  return {image, geometry};
}

} // namespace homeward
