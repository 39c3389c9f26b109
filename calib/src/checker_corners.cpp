// SPDX-License-Identifier: GPL-3.0-or-later
#include "checker_corners.h"

#include <homeward/core/angle.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace homeward
{
namespace
{

constexpr int kBorder = 6;            ///< pixels of the picture's edge that are not searched
constexpr double kLeastContrast = 15; ///< gray levels between dark and bright sectors
constexpr std::size_t kMost = 1500;   ///< corners; the strongest are kept
constexpr int kTurns = 32;            ///< samples of a ring

double levelAt(const cv::Mat1b &picture, const Eigen::Vector2d &pixel)
{
  const auto u = static_cast<int>(std::floor(pixel.x()));
  const auto v = static_cast<int>(std::floor(pixel.y()));
  if (u < 0 || v < 0 || u + 1 >= picture.cols || v + 1 >= picture.rows) {
    return 0.0;
  }
  const double a = pixel.x() - u;
  const double b = pixel.y() - v;
  return (1.0 - b) * ((1.0 - a) * picture(v, u) + a * picture(v, u + 1)) +
         b * ((1.0 - a) * picture(v + 1, u) + a * picture(v + 1, u + 1));
}

/** Minus the determinant of the second derivatives: large at saddles only. */
cv::Mat1f saddles(const cv::Mat1b &smooth)
{
  cv::Mat1f xx;
  cv::Mat1f yy;
  cv::Mat1f xy;
  cv::Sobel(smooth, xx, CV_32F, 2, 0, 3, 0.25);
  cv::Sobel(smooth, yy, CV_32F, 0, 2, 3, 0.25);
  cv::Sobel(smooth, xy, CV_32F, 1, 1, 3, 0.25);
  return cv::Mat(xy.mul(xy) - xx.mul(yy));
}

/** Pixels whose saddle is the strongest nearby, strongest first. */
std::vector<cv::Point> peaks(const cv::Mat1f &response)
{
  constexpr float kFaint = 20.0F; // gray levels^2 a pixel^4; a corner of 20 gray levels has more
  cv::Mat1f highest;
  cv::dilate(response, highest, cv::Mat::ones(5, 5, CV_8U));
  std::vector<cv::Point> found;
  for (int v = kBorder; v < response.rows - kBorder; ++v) {
    const float *row = response[v];
    for (int u = kBorder; u < response.cols - kBorder; ++u) {
      if (row[u] > kFaint && row[u] >= highest(v, u)) {
        found.emplace_back(u, v);
      }
    }
  }
  std::stable_sort(found.begin(), found.end(), [&](const cv::Point &a, const cv::Point &b) {
    return response(a) > response(b);
  });
  return found;
}

/** Brightness round a place, against the middle between the darkest and the brightest. */
std::array<double, kTurns> ringAround(const cv::Mat1b &smooth, const Eigen::Vector2d &pixel,
                                      double radius, double &contrast)
{
  std::array<double, kTurns> ring{};
  for (int i = 0; i < kTurns; ++i) {
    const double angle = 2.0 * kPi * i / kTurns;
    ring[static_cast<std::size_t>(i)] =
        levelAt(smooth, pixel + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const auto [darkest, brightest] = std::minmax_element(ring.begin(), ring.end());
  contrast = *brightest - *darkest;
  const double middle = (*brightest + *darkest) / 2.0;
  for (double &level : ring) {
    level -= middle;
  }
  return ring;
}

/** The edge through two crossings of a ring that lie across from each other. */
std::optional<double> edgeThrough(const std::vector<double> &crossings)
{
  if (crossings.size() != 2) {
    return std::nullopt;
  }
  const double fault = wrapAngle(crossings[1] - crossings[0] - kPi);
  constexpr double kStraight = radians(35.0);
  return std::abs(fault) < kStraight ? std::optional(crossings[0] + fault / 2.0) : std::nullopt;
}

std::optional<CheckerCorner> cornerAt(const cv::Mat1b &smooth, const Eigen::Vector2d &pixel,
                                      double radius)
{
  CheckerCorner corner{pixel, {}, {}, 0.0};
  const auto ring = ringAround(smooth, pixel, radius, corner.contrast);
  if (corner.contrast < kLeastContrast) {
    return std::nullopt;
  }
  std::vector<double> rising;
  std::vector<double> falling;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double now = ring[i];
    const double next = ring[(i + 1) % ring.size()];
    if ((now < 0.0) != (next < 0.0)) {
      const double angle = 2.0 * kPi * (static_cast<double>(i) + now / (now - next)) / kTurns;
      (now < 0.0 ? rising : falling).push_back(angle);
    }
  }
  const auto up = edgeThrough(rising);
  const auto down = edgeThrough(falling);
  if (!up || !down) {
    return std::nullopt;
  }
  corner.rising = {std::cos(*up), std::sin(*up)};
  corner.falling = {std::cos(*down), std::sin(*down)};
  constexpr double kLeastSine = 0.3;
  const double sine =
      corner.rising.x() * corner.falling.y() - corner.rising.y() * corner.falling.x();
  return std::abs(sine) > kLeastSine ? std::optional(corner) : std::nullopt;
}

} // namespace

std::vector<CheckerCorner> checkerCorners(const cv::Mat1b &smooth)
{
  std::vector<CheckerCorner> corners;
  for (const cv::Point &peak : peaks(saddles(smooth))) {
    // The wide ring tells directions better, the narrow one fits into small checkers.
    for (const double radius : {5.0, 3.0}) {
      if (const auto corner = cornerAt(smooth, {peak.x, peak.y}, radius)) {
        corners.push_back(*corner);
        break;
      }
    }
    if (corners.size() >= kMost) {
      break;
    }
  }
  return corners;
}

bool joinedByEdge(const cv::Mat1b &smooth, const Eigen::Vector2d &from, const Eigen::Vector2d &to,
                  bool brightLeft, double contrast)
{
  const Eigen::Vector2d way = to - from;
  const double length = way.norm();
  Eigen::Vector2d left(-way.y(), way.x());
  left *= std::max(0.15, 1.5 / length) * (brightLeft ? 1.0 : -1.0);
  const int samples = std::clamp(static_cast<int>(length / 2.0), 4, 16);
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d place = from + (0.2 + 0.6 * i / (samples - 1)) * way;
    if (levelAt(smooth, place + left) - levelAt(smooth, place - left) < contrast) {
      return false;
    }
  }
  return true;
}

} // namespace homeward
