// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a calibration board for who has no mirror at hand.
#pragma once

#include <homeward/calib/target.h>
#include <homeward/camera/unified_camera.h>
#include <homeward/core/angle.h>
#include <homeward/core/random.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace boards
{

using homeward::ArtRectangle;
using homeward::radians;
using homeward::Random;
using homeward::TargetArt;
using homeward::UnifiedCamera;

constexpr int kRoom = 120; // how bright everything but the board is
constexpr int kRim = 345;  // pixels, radius of the mirror in the picture

/** The board as a printer would print it, one pixel a millimetre. */
inline cv::Mat1b print(const TargetArt &art)
{
  cv::Mat1b paper(cvRound(1000.0 * art.height), cvRound(1000.0 * art.width), uchar{230});
  for (const ArtRectangle &r : art.rectangles) {
    paper(cv::Rect(cvRound(1000.0 * r.x), cvRound(1000.0 * r.y), cvRound(1000.0 * r.width),
                   cvRound(1000.0 * r.height))) = 25;
  }
  return paper;
}

/** A picture of the board at cMo: every pixel's ray meets the board's plane somewhere. */
inline cv::Mat1b photograph(const UnifiedCamera &camera, const TargetArt &art,
                            const Eigen::Isometry3d &cMo)
{
  constexpr int kSamples = 2; // a pixel each way, against jagged edges
  const Eigen::Isometry3d oMc = cMo.inverse();
  cv::Mat2f where(kSamples * camera.height(), kSamples * camera.width());
  where.forEach([&](cv::Vec2f &point, const int *index) {
    const Eigen::Vector2d pixel((index[1] + 0.5) / kSamples - 0.5,
                                (index[0] + 0.5) / kSamples - 0.5);
    const Eigen::Vector3d ray = camera.unproject(pixel).value_or(Eigen::Vector3d::UnitX());
    const Eigen::Vector3d direction = oMc.linear() * ray;
    const double along = -oMc.translation().z() / direction.z();
    const Eigen::Vector2d hit = (oMc.translation() + along * direction).head<2>() + art.origin;
    point = along > 0.0 && along < 5.0 ? cv::Vec2f(1000.0F * static_cast<float>(hit.x()) - 0.5F,
                                                   1000.0F * static_cast<float>(hit.y()) - 0.5F)
                                       : cv::Vec2f(-9.0F, -9.0F);
  });
  cv::Mat1b fine;
  cv::Mat1b picture;
  cv::remap(print(art), fine, where, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, kRoom);
  cv::resize(fine, picture, {camera.width(), camera.height()}, 0.0, 0.0, cv::INTER_AREA);
  const cv::Point centre(cvRound(camera.parameters().cx), cvRound(camera.parameters().cy));
  cv::circle(picture, centre, kRim + 500, 15, 1000); // beyond the mirror
  cv::circle(picture, centre, 45, 15, cv::FILLED);   // the camera itself
  return picture;
}

/** A board somewhere round the camera, half a metre away, facing it, more or less. */
inline Eigen::Isometry3d held(int number, const Eigen::Vector3d &middle, Random &random)
{
  const double azimuth = radians(137.5) * number; // the golden angle spreads them
  const double below = radians(20.0 * (number % 3));
  const Eigen::Vector3d towards(std::cos(below) * std::cos(azimuth),
                                std::cos(below) * std::sin(azimuth), std::sin(below));
  Eigen::Matrix3d facing;
  facing.col(2) = towards;
  facing.col(0) = Eigen::Vector3d::UnitZ().cross(towards).normalized();
  facing.col(1) = facing.col(2).cross(facing.col(0));
  Eigen::Isometry3d cMo = Eigen::Isometry3d::Identity();
  cMo.linear() = facing;
  for (int axis = 0; axis < 3; ++axis) {
    const double tilt = radians(random.uniform(-30.0, 30.0));
    cMo.rotate(Eigen::AngleAxisd(tilt, Eigen::Vector3d::Unit(axis)));
  }
  cMo.translation() = random.uniform(0.4, 0.6) * towards - cMo.linear() * middle;
  return cMo;
}

} // namespace boards
