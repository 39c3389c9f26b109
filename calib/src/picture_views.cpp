// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_views.h"

#include <homeward/core/angle.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>

namespace homeward
{

namespace
{

/** A map for cv::remap(), exact every few pixels and bilinear between. */
cv::Mat2f smoothMap(int side,
                    const std::function<Eigen::Vector2d(const Eigen::Vector2d &)> &toPicture)
{
  constexpr int kStep = 8;
  const int nodes = side / kStep + 2;
  cv::Mat2f coarse(nodes, nodes);
  for (int row = 0; row < nodes; ++row) {
    for (int column = 0; column < nodes; ++column) {
      const Eigen::Vector2f pixel =
          toPicture({static_cast<double>(column * kStep), static_cast<double>(row * kStep)})
              .cast<float>();
      coarse(row, column) = {pixel.x(), pixel.y()};
    }
  }
  cv::Mat2f map(side, side);
  for (int row = 0; row < side; ++row) {
    const cv::Vec2f *above = coarse[row / kStep];
    const cv::Vec2f *below = coarse[row / kStep + 1];
    const float down = static_cast<float>(row % kStep) / kStep;
    for (int column = 0; column < side; ++column) {
      const int k = column / kStep;
      const float right = static_cast<float>(column % kStep) / kStep;
      map(row, column) = (1.0F - down) * ((1.0F - right) * above[k] + right * above[k + 1]) +
                         down * ((1.0F - right) * below[k] + right * below[k + 1]);
    }
  }
  return map;
}

} // namespace

PictureView enlarged(const cv::Mat1b &picture, double factor)
{
  if (factor == 1.0) {
    return {picture, [](const Eigen::Vector2d &pixel) { return pixel; }};
  }
  cv::Mat1b image;
  cv::resize(picture, image, {}, factor, factor, cv::INTER_CUBIC);
  return {image, [factor](const Eigen::Vector2d &pixel) {
            return Eigen::Vector2d((pixel.array() + 0.5) / factor - 0.5);
          }};
}

PictureView flipped(const PictureView &view)
{
  cv::Mat1b image;
  cv::flip(view.image, image, 1);
  const double last = image.cols - 1.0;
  return {image, [toPicture = view.toPicture, last](const Eigen::Vector2d &pixel) {
            return toPicture({last - pixel.x(), pixel.y()});
          }};
}

std::vector<PatchAim> aimsRound(double width)
{
  constexpr int kTurns = 10;
  constexpr std::array kAngles{radians(58.0), radians(92.0)};
  std::vector<PatchAim> aims;
  for (int i = 0; i < kTurns; ++i) {
    for (const double angle : kAngles) {
      const double shift = angle == kAngles[0] ? 0.0 : 0.5;
      aims.push_back({2.0 * kPi * (i + shift) / kTurns, angle, width});
    }
  }
  return aims;
}

PictureView straightened(const cv::Mat1b &picture, const UnifiedCamera &camera, const PatchAim &aim,
                         double scale)
{
  Eigen::Matrix3d cRv; // z into the scene, y towards the picture's middle
  cRv.col(2) = Eigen::Vector3d(std::sin(aim.angle) * std::cos(aim.azimuth),
                               std::sin(aim.angle) * std::sin(aim.azimuth), std::cos(aim.angle));
  cRv.col(0) = Eigen::Vector3d::UnitZ().cross(cRv.col(2)).normalized();
  cRv.col(1) = cRv.col(2).cross(cRv.col(0));
  // As many pixels a radian in the middle as the picture has there along the circle.
  const auto middle = camera.project(cRv.col(2));
  const Eigen::Vector2d centre(camera.parameters().cx, camera.parameters().cy);
  const double radius = middle ? (*middle - centre).norm() : camera.parameters().fx;
  const double focal = scale * radius / std::sin(aim.angle);
  const int side = std::max(32, cvRound(2.0 * focal * std::tan(aim.width / 2.0)));
  const double half = (side - 1) / 2.0;
  const auto toPicture = [=](const Eigen::Vector2d &pixel) {
    const Eigen::Vector3d ray =
        cRv * Eigen::Vector3d((pixel.x() - half) / focal, (pixel.y() - half) / focal, 1.0);
    return camera.project(ray).value_or(Eigen::Vector2d(-1.0, -1.0));
  };
  const cv::Mat2f map = smoothMap(side, toPicture);
  cv::Mat1b image;
  cv::remap(picture, image, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return {image, toPicture};
}

} // namespace homeward
