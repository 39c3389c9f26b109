// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>
#include <homeward/core/pose2.h>
#include <homeward/core/random.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace homeward
{

/** Light on the synthetic room: intensity = gain * (1 + slope cos(normal - from)) * paint + offset.
 */
struct RoomLight
{
  double gain = 1.0;
  double offset = 0.0; ///< gray levels
  double slope = 0.0;  ///< how much brighter the walls are that face `from`
  double from = 0.0;   ///< azimuth in the room, radians
};

/**
 * A rectangular room painted by seeded noise and rectangles, seen by exact ray casting. The origin
 * is in the middle of the floor; it spans length along x and width along y.
 */
class SyntheticRoom
{
public:
  SyntheticRoom(std::uint64_t seed, double length, double width, double height = 2.8)
      : m_half{length / 2.0, width / 2.0}, m_height(height)
  {
    for (int side = 0; side < kSides; ++side) {
      const bool flat = side >= 4;
      const double across = flat ? length : (side < 2 ? width : length);
      const double up = flat ? width : height;
      Random random(seed, static_cast<std::uint32_t>(side));
      m_paint[static_cast<std::size_t>(side)] = paint(random, across, up);
    }
  }

  /** What a robot at `pose` sees, gray, eye 0.9 m above the floor. */
  Panorama view(const Pose2 &pose, const RoomLight &light = {},
                const PanoramaGeometry &geometry = {}) const
  {
    Panorama panorama{cv::Mat(geometry.height, geometry.width, CV_8UC1), geometry};
    for (int u = 0; u < geometry.width; ++u) {
      const double azimuth = geometry.azimuth(u) + pose.heading;
      const double dx = std::cos(azimuth);
      const double dy = std::sin(azimuth);
      for (int v = 0; v < geometry.height; ++v) {
        const double level = look(pose, dx, dy, std::tan(geometry.elevation(v)), light);
        panorama.image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(level);
      }
    }
    return panorama;
  }

private:
  static constexpr int kSides = 6; ///< x+, x-, y+, y-, floor, ceiling
  static constexpr double kTexel = 0.02;
  static constexpr double kEye = 0.9;

  /** Gray levels 20 to 235 over `across` x `up` metres: smooth noise and a few rectangles. */
  static cv::Mat paint(Random &random, double across, double up)
  {
    const cv::Size size(static_cast<int>(across / kTexel) + 2, static_cast<int>(up / kTexel) + 2);
    cv::Mat sum = cv::Mat::zeros(size, CV_32F);
    for (const double cell : {1.2, 0.5, 0.2}) {
      cv::Mat coarse(static_cast<int>(up / cell) + 3, static_cast<int>(across / cell) + 3, CV_32F);
      coarse.forEach<float>([](float &value, const int *) { value = 0.0F; });
      for (int r = 0; r < coarse.rows; ++r) {
        for (int c = 0; c < coarse.cols; ++c) {
          coarse.at<float>(r, c) = static_cast<float>(random.uniform(-30.0, 30.0));
        }
      }
      cv::Mat fine;
      cv::resize(coarse, fine, size, 0.0, 0.0, cv::INTER_CUBIC);
      sum += fine;
    }
    sum += static_cast<float>(random.uniform(110.0, 150.0));
    const int count = static_cast<int>(across * up * 0.8);
    for (int i = 0; i < count; ++i) {
      const cv::Rect patch(static_cast<int>(random.uniform(0.0, 1.0) * size.width),
                           static_cast<int>(random.uniform(0.0, 1.0) * size.height),
                           static_cast<int>(random.uniform(0.1, 1.0) / kTexel),
                           static_cast<int>(random.uniform(0.1, 1.0) / kTexel));
      sum(patch & cv::Rect({}, size)) += static_cast<float>(random.uniform(-60.0, 60.0));
    }
    cv::Mat blurred;
    cv::GaussianBlur(cv::min(cv::max(sum, 20.0), 235.0), blurred, {}, 1.0);
    return blurred;
  }

  float texel(int side, double across, double up) const
  {
    const cv::Mat &paint = m_paint[static_cast<std::size_t>(side)];
    const double x = std::clamp(across / kTexel, 0.0, paint.cols - 1.001);
    const double y = std::clamp(up / kTexel, 0.0, paint.rows - 1.001);
    const int c = static_cast<int>(x);
    const int r = static_cast<int>(y);
    const auto fx = static_cast<float>(x - c);
    const auto fy = static_cast<float>(y - r);
    const float upper = paint.at<float>(r, c) * (1 - fx) + paint.at<float>(r, c + 1) * fx;
    const float lower = paint.at<float>(r + 1, c) * (1 - fx) + paint.at<float>(r + 1, c + 1) * fx;
    return upper * (1 - fy) + lower * fy;
  }

  /** Gray level along (dx, dy, slope), (dx, dy) of length one. */
  double look(const Pose2 &pose, double dx, double dy, double slope, const RoomLight &light) const
  {
    const double alongX = ((dx > 0.0 ? m_half[0] : -m_half[0]) - pose.x) / dx;
    const double alongY = ((dy > 0.0 ? m_half[1] : -m_half[1]) - pose.y) / dy;
    const double ground = slope < 0.0 ? -kEye / slope : (m_height - kEye) / std::max(slope, 1e-9);
    const double along =
        std::min({dx == 0.0 ? ground : alongX, dy == 0.0 ? ground : alongY, ground});
    const double x = pose.x + along * dx;
    const double y = pose.y + along * dy;
    const double z = kEye + along * slope;
    double level = 0.0;
    double facing = 0.0;
    if (along == ground) {
      level = texel(slope < 0.0 ? 4 : 5, x + m_half[0], y + m_half[1]);
    }
    else if (along == alongX) {
      level = texel(dx > 0.0 ? 0 : 1, y + m_half[1], z);
      facing = std::cos((dx > 0.0 ? kPi : 0.0) - light.from);
    }
    else {
      level = texel(dy > 0.0 ? 2 : 3, x + m_half[0], z);
      facing = std::cos((dy > 0.0 ? -kPi / 2.0 : kPi / 2.0) - light.from);
    }
    return light.gain * (1.0 + light.slope * facing) * level + light.offset;
  }

  std::array<double, 2> m_half;
  double m_height;
  std::array<cv::Mat, kSides> m_paint;
};

/** Bearing of home in the current robot's frame, radians. */
inline double trueDirection(const Pose2 &current, const Pose2 &home)
{
  const Eigen::Vector2d seen = current.inverse() * home.translation();
  return std::atan2(seen.y(), seen.x());
}

} // namespace homeward
