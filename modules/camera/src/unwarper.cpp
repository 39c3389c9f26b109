// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/unwarper.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <string>

namespace homeward
{
namespace
{

/** Ray in frame c of a direction in frame p. */
Eigen::Vector3d cameraRay(const CameraMount &mount, double azimuth, double elevation)
{
  const double angle = mount.forward + (mount.leftIsClockwise ? azimuth : -azimuth);
  return {std::cos(elevation) * std::cos(angle), std::cos(elevation) * std::sin(angle),
          -std::sin(elevation)};
}

const PanoramaGeometry &checked(const PanoramaGeometry &geometry)
{
  if (geometry.width <= 0 || geometry.height <= 0 ||
      !(geometry.elevationMin < geometry.elevationMax) ||
      !(geometry.elevationMin >= -kPi / 2.0 && geometry.elevationMax <= kPi / 2.0)) {
    throw LogicError("a panorama of " + std::to_string(geometry.width) + " x " +
                     std::to_string(geometry.height) + " pixels from " +
                     std::to_string(degrees(geometry.elevationMin)) + " to " +
                     std::to_string(degrees(geometry.elevationMax)) +
                     " degrees of elevation is impossible");
  }
  return geometry;
}

} // namespace

Unwarper::Unwarper(const MirrorCamera &camera, const PanoramaGeometry &geometry)
    : m_geometry(checked(geometry)), m_pictureSize(camera.model.width(), camera.model.height()),
      m_visible(geometry.height, geometry.width, CV_8UC1, cv::Scalar(0))
{
  constexpr float kNowhere = -10.0F;
  const auto &p = camera.model.parameters();
  cv::Mat2f map(geometry.height, geometry.width, cv::Vec2f(kNowhere, kNowhere));
  for (int row = 0; row < geometry.height; ++row) {
    for (int column = 0; column < geometry.width; ++column) {
      const auto pixel = camera.model.project(
          cameraRay(camera.mount, geometry.azimuth(column), geometry.elevation(row)));
      if (!pixel) {
        continue;
      }
      const double radius = (*pixel - Eigen::Vector2d(p.cx, p.cy)).norm();
      const bool inPicture = pixel->x() >= 0.0 && pixel->y() >= 0.0 &&
                             pixel->x() <= m_pictureSize.width - 1.0 &&
                             pixel->y() <= m_pictureSize.height - 1.0;
      if (inPicture && radius >= camera.ring.inner && radius <= camera.ring.outer) {
        map(row, column) = {static_cast<float>(pixel->x()), static_cast<float>(pixel->y())};
        m_visible.at<uchar>(row, column) = 255;
      }
    }
  }
  cv::convertMaps(map, cv::noArray(), m_map1, m_map2, CV_16SC2);
}

Panorama Unwarper::unwarp(const cv::Mat &picture) const
{
  if (picture.size() != m_pictureSize || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3)) {
    throw LogicError(
        "a picture of " + std::to_string(picture.cols) + " x " + std::to_string(picture.rows) +
        " pixels, type " + std::to_string(picture.type()) +
        ", cannot be unwarped; the camera file says " + std::to_string(m_pictureSize.width) +
        " x " + std::to_string(m_pictureSize.height) + ", 8-bit gray or BGR");
  }
  Panorama panorama{{}, m_geometry};
  cv::remap(picture, panorama.image, m_map1, m_map2, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  panorama.image.setTo(cv::Scalar::all(0), m_visible == 0);
  return panorama;
}

} // namespace homeward
