// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/target.h>
#include <homeward/core/angle.h>
#include <homeward/core/random.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace homeward
{

/** The art of a target as pixels, white 255. */
inline cv::Mat1b rasterise(const TargetArt &art, double pixelsPerMetre)
{
  constexpr int kShift = 8; // pixels are given in 1/256
  const auto at = [&](double metres) { return cvRound((metres * pixelsPerMetre - 0.5) * 256.0); };
  cv::Mat1b image(cvCeil(art.height * pixelsPerMetre), cvCeil(art.width * pixelsPerMetre), 255);
  for (const ArtRectangle &r : art.rectangles) {
    const int left = cvRound(r.x * pixelsPerMetre);
    const int top = cvRound(r.y * pixelsPerMetre);
    const int right = cvRound((r.x + r.width) * pixelsPerMetre);
    const int bottom = cvRound((r.y + r.height) * pixelsPerMetre);
    image(cv::Rect(left, top, right - left, bottom - top)) = 0;
  }
  for (const ArtDisc &disc : art.discs) {
    cv::circle(image, {at(disc.x), at(disc.y)}, cvRound(disc.radius * pixelsPerMetre * 256.0), 0,
               cv::FILLED, cv::LINE_AA, kShift);
  }
  return image;
}

/** Takes pictures of a board as a mirror camera sees it, one exact ray a sample. */
class BoardPainter
{
public:
  /** Unit ray in frame c, or nothing; as a camera's unproject(). */
  using RayOf = std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector2d &)>;

  struct Mirror
  {
    cv::Size size;
    Eigen::Vector2d centre; ///< pixels
    double inner = 0.0;     ///< pixels
    double outer = 0.0;     ///< pixels
  };

  BoardPainter(const RayOf &rayOf, const Mirror &mirror, const Target &target)
      : m_mirror(mirror), m_art(drawTarget(target)), m_paint(rasterise(m_art, kResolution))
  {
    m_rays.reserve(static_cast<std::size_t>(mirror.size.area()) * kSide * kSide);
    m_room.reserve(m_rays.capacity());
    for (int v = 0; v < mirror.size.height; ++v) {
      for (int u = 0; u < mirror.size.width; ++u) {
        for (int k = 0; k < kSide * kSide; ++k) {
          const Eigen::Vector2d pixel(u + (k % kSide + 0.5) / kSide - 0.5,
                                      v + (k / kSide + 0.5) / kSide - 0.5); // NOLINT
          const double radius = (pixel - mirror.centre).norm();
          const auto ray = radius > mirror.inner && radius < mirror.outer
                               ? rayOf(pixel)
                               : std::optional<Eigen::Vector3d>();
          m_rays.push_back(ray ? ray->cast<float>().eval() : Eigen::Vector3f::Zero().eval());
          m_room.push_back(room(m_rays.back()));
        }
      }
    }
  }

  /** Gray picture of the board at cMo in a plain room, blurred a little, with noise. */
  cv::Mat1b paint(const Eigen::Isometry3d &cMo, Random &random, double noise = 3.0) const
  {
    const Eigen::Isometry3f oMc = cMo.inverse().cast<float>();
    const Eigen::Matrix3f oRc = oMc.linear();
    const Eigen::Vector3f origin = oMc.translation();
    cv::Mat1f picture(m_mirror.size);
    std::size_t i = 0;
    for (float &level : picture) {
      float sum = 0.0F;
      for (int k = 0; k < kSide * kSide; ++k) {
        sum += paintAt(origin, oRc * m_rays[i]).value_or(m_room[i]);
        ++i;
      }
      level = sum / (kSide * kSide);
    }
    cv::GaussianBlur(picture, picture, {}, 0.5);
    cv::Mat1b result(picture.size());
    std::transform(picture.begin(), picture.end(), result.begin(), [&](float level) {
      return cv::saturate_cast<uchar>(level + random.normal(noise));
    });
    return result;
  }

private:
  static constexpr int kSide = 3;               ///< samples a pixel, each way
  static constexpr float kResolution = 4000.0F; ///< pixels a metre of the paint

  /** The level where a ray of frame o meets the board. */
  std::optional<float> paintAt(const Eigen::Vector3f &origin,
                               const Eigen::Vector3f &direction) const
  {
    const float along = -origin.z() / direction.z();
    if (!(along > 0.0F)) {
      return std::nullopt;
    }
    const Eigen::Vector3f hit = origin + along * direction;
    const float x = (hit.x() + static_cast<float>(m_art.origin.x())) * kResolution;
    const float y = (hit.y() + static_cast<float>(m_art.origin.y())) * kResolution;
    if (x >= 0.0F && y >= 0.0F && x < static_cast<float>(m_paint.cols) &&
        y < static_cast<float>(m_paint.rows)) {
      return 30.0F + 0.75F * m_paint(static_cast<int>(y), static_cast<int>(x));
    }
    return std::nullopt;
  }

  /** A room: dark tiled floor, bright walls with pilasters, ceiling. */
  static float room(const Eigen::Vector3f &ray)
  {
    if (ray.isZero()) {
      return 12.0F; // the housing
    }
    const float azimuth = std::atan2(ray.y(), ray.x());
    const float wall = 120.0F + 25.0F * std::sin(5.0F * azimuth) +
                       (std::sin(23.0F * azimuth) > 0.7F ? 30.0F : 0.0F);
    if (ray.z() > 0.35F) {
      const float x = 2.0F * ray.x() / ray.z();
      const float y = 2.0F * ray.y() / ray.z();
      return std::sin(4.0F * x) * std::sin(4.0F * y) > 0.0F ? 70.0F : 85.0F;
    }
    return ray.z() < -0.3F ? 170.0F : wall;
  }

  Mirror m_mirror;
  TargetArt m_art;
  cv::Mat1b m_paint;
  std::vector<Eigen::Vector3f> m_rays; ///< zero where there is none
  std::vector<float> m_room;           ///< what each shows behind the board
};

/**
 * Boards all round a mirror whose axis points down: facing it, nearer and farther, below and at the
 * horizon, tilted and turned. The board's middle is `middle` in its own frame.
 * @param nearest, farthest metres from the mirror
 * @param highest elevation of a board's middle, radians
 */
inline std::vector<Eigen::Isometry3d> posesRound(int count, const Eigen::Vector3d &middle,
                                                 double nearest, double farthest, Random &random,
                                                 double highest = radians(8.0))
{
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i) {
    const double azimuth = 2.399963 * i; // the golden angle spreads them
    const double below = radians(20.0 * (i % 3)) - highest;
    const Eigen::Vector3d towards(std::cos(below) * std::cos(azimuth),
                                  std::cos(below) * std::sin(azimuth), std::sin(below));
    Eigen::Matrix3d cRo;
    cRo.col(2) = towards;
    cRo.col(0) = Eigen::Vector3d::UnitZ().cross(towards).normalized();
    cRo.col(1) = cRo.col(2).cross(cRo.col(0));
    const auto turn = [&](double most, const Eigen::Vector3d &axis) {
      return Eigen::AngleAxisd(radians(random.uniform(-most, most)), axis);
    };
    Eigen::Isometry3d cMo = Eigen::Isometry3d::Identity();
    cMo.linear() = cRo * turn(35.0, Eigen::Vector3d::UnitX()) *
                   turn(35.0, Eigen::Vector3d::UnitY()) * turn(40.0, Eigen::Vector3d::UnitZ());
    cMo.translation() = random.uniform(nearest, farthest) * towards - cMo.linear() * middle;
    poses.push_back(cMo);
  }
  return poses;
}

} // namespace homeward
