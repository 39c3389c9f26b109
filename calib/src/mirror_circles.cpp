// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/mirror_circles.h>

#include "circle_search.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{
namespace
{

constexpr double kJustInside = 0.85; ///< share of a circle's radius
constexpr double kDisc = 0.3;        ///< likewise: all but the middle
constexpr double kConvincing = 0.1;  ///< least support times change of texture
constexpr int kTurns = 720;          ///< places on a circle where texture is sampled

/** Mean change from one place to the next along a circle; nothing where the picture ends. */
std::optional<double> textureAt(const cv::Mat1b &picture, const Eigen::Vector2d &centre,
                                double radius)
{
  double sum = 0.0;
  int count = 0;
  int last = -1;
  for (int i = 0; i < kTurns; ++i) {
    const double angle = 2.0 * kPi * i / kTurns;
    const int u = cvRound(centre.x() + radius * std::cos(angle));
    const int v = cvRound(centre.y() + radius * std::sin(angle));
    if (u < 0 || v < 0 || u >= picture.cols || v >= picture.rows) {
      last = -1;
      continue;
    }
    if (last >= 0) {
      sum += std::abs(picture(v, u) - last);
      ++count;
    }
    last = picture(v, u);
  }
  return count > kTurns / 8 ? std::optional(sum / count) : std::nullopt;
}

/** Mean texture of the rings from `from` to `to` times the circle's radius. */
double textureOf(const cv::Mat1b &picture, const Circle &circle, double from, double to)
{
  constexpr int kRings = 6;
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < kRings; ++i) {
    const double share = from + (to - from) * i / (kRings - 1);
    if (const auto texture = textureAt(picture, circle.centre, share * circle.radius)) {
      sum += *texture;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

/** How much more happens inside, from the share `from` of the radius on, than outside; -1 to 1. */
double fallOfTexture(const cv::Mat1b &picture, const Circle &circle, double from)
{
  constexpr double kCalm = 0.5; // gray levels; noise is no texture
  const double inside = textureOf(picture, circle, from, 0.97);
  const double outside = textureOf(picture, circle, 1.03, 1.12);
  return (inside - outside) / (inside + outside + kCalm);
}

/** What hides the middle: a calm disc with the scene round it; radius 0 where there is none. */
Circle innerCircle(const cv::Mat1b &picture, const std::vector<SupportedCircle> &circles,
                   const Circle &outer)
{
  struct Candidate
  {
    Circle circle;
    double inside;
    double score;
  };
  std::vector<Candidate> candidates;
  double calmest = 1e9;
  for (const auto &[circle, support] : circles) {
    const double score = -support * fallOfTexture(picture, circle, kDisc);
    const bool within = circle.radius < 0.75 * outer.radius &&
                        (circle.centre - outer.centre).norm() < 0.12 * outer.radius;
    if (within && support > 0.75 && score > kConvincing) {
      candidates.push_back({circle, textureOf(picture, circle, kDisc, 0.97), score});
      calmest = std::min(calmest, candidates.back().inside);
    }
  }
  Circle best{outer.centre, 0.0};
  double score = 0.0;
  for (const Candidate &candidate : candidates) {
    // The lens shows rings of its own, the floor is calmer than the walls.
    if (candidate.inside < 1.5 * calmest && candidate.score > score) {
      score = candidate.score;
      best = candidate.circle;
    }
  }
  return best;
}

} // namespace

std::optional<MirrorCircles> findMirror(const cv::Mat &picture)
{
  if (picture.empty() || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3)) {
    throw LogicError("a mirror is found in an 8-bit gray or BGR picture, not in type " +
                     std::to_string(picture.type()));
  }
  cv::Mat1b gray;
  if (picture.channels() == 3) {
    cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  }
  else {
    gray = picture;
  }
  cv::Mat1b smooth;
  cv::GaussianBlur(gray, smooth, {}, 1.0 + 0.001 * gray.cols);
  const std::vector<SupportedCircle> circles = searchCircles(smooth);
  MirrorCircles mirror;
  double best = kConvincing;
  for (const SupportedCircle &circle : circles) {
    const double score = circle.support * fallOfTexture(smooth, circle.circle, kJustInside);
    if (score > best) {
      best = score;
      mirror.outer = circle.circle;
    }
  }
  if (!(mirror.outer.radius > 0.0)) {
    return std::nullopt;
  }
  mirror.inner = innerCircle(smooth, circles, mirror.outer);
  return mirror;
}

cv::Mat mirrorMask(const MirrorCircles &mirror, int width, int height)
{
  cv::Mat1b mask(height, width, uchar{0});
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector2d pixel(u, v);
      const bool shown = (pixel - mirror.outer.centre).norm() <= mirror.outer.radius &&
                         (pixel - mirror.inner.centre).norm() >= mirror.inner.radius;
      mask(v, u) = shown ? 255 : 0;
    }
  }
  return mask;
}

UnifiedCamera roughCamera(const std::optional<MirrorCircles> &mirror, int width, int height)
{
  constexpr double kRim = radians(115.0); // from the axis: such mirrors end 20 to 30 degrees above
                                          // the horizon
  Circle outer{{(width - 1) / 2.0, (height - 1) / 2.0}, std::min(width, height) / 2.0};
  if (mirror) {
    outer = mirror->outer;
  }
  UnifiedCamera::Parameters parameters;
  parameters.xi = 1.0;
  parameters.fx = outer.radius * (std::cos(kRim) + parameters.xi) / std::sin(kRim);
  parameters.fy = parameters.fx;
  parameters.cx = outer.centre.x();
  parameters.cy = outer.centre.y();
  return {parameters, width, height};
}

} // namespace homeward
