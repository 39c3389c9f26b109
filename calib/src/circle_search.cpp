// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_search.h"

#include <homeward/core/angle.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>

namespace homeward
{
namespace
{

constexpr int kRays = 360;
constexpr std::size_t kEdgesPerRay = 12;
constexpr std::size_t kCircles = 10;
constexpr float kLeastStep = 10.0F; ///< gray levels across an edge

/** Edges seen along one ray from the middle of the picture. */
using RayEdges = std::vector<Eigen::Vector2d>;

/** The strongest steps of brightness along a ray. */
RayEdges edgesAlong(const cv::Mat1b &picture, const Eigen::Vector2d &from, double angle,
                    double reach)
{
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  std::vector<float> profile;
  for (double r = 0.0;; r += 1.0) {
    const Eigen::Vector2d pixel = from + r * direction;
    if (pixel.x() < 0.0 || pixel.y() < 0.0 || pixel.x() >= picture.cols - 1.0 ||
        pixel.y() >= picture.rows - 1.0) {
      break;
    }
    profile.push_back(picture(cvRound(pixel.y()), cvRound(pixel.x())));
  }
  const int gap = std::max(2, cvRound(reach));
  const auto size = static_cast<int>(profile.size());
  std::vector<float> step(profile.size(), 0.0F);
  for (int r = gap; r + gap < size; ++r) {
    step[static_cast<std::size_t>(r)] =
        std::abs(profile[static_cast<std::size_t>(r) + static_cast<std::size_t>(gap)] -
                 profile[static_cast<std::size_t>(r) - static_cast<std::size_t>(gap)]);
  }
  std::vector<std::pair<float, double>> peaks;
  for (int r = gap; r + gap < size; ++r) {
    const auto begin = step.begin() + r - gap;
    const float here = step[static_cast<std::size_t>(r)];
    if (here >= kLeastStep && here >= *std::max_element(begin, begin + 2 * gap + 1)) {
      int plateau = 0; // whole pixels round to equal steps: take the middle
      while (r + plateau + 1 < size &&
             step[static_cast<std::size_t>(r) + static_cast<std::size_t>(plateau) + 1] == here) {
        ++plateau;
      }
      peaks.emplace_back(-here, r + plateau / 2.0);
      r += plateau;
    }
  }
  std::sort(peaks.begin(), peaks.end());
  RayEdges edges;
  for (std::size_t i = 0; i < std::min(kEdgesPerRay, peaks.size()); ++i) {
    edges.emplace_back(from + peaks[i].second * direction);
  }
  return edges;
}

/** Share of a circle that the picture shows. */
double shown(const Circle &circle, const cv::Size &size)
{
  int inside = 0;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2.0 * kPi * i / kRays;
    const double u = circle.centre.x() + circle.radius * std::cos(angle);
    const double v = circle.centre.y() + circle.radius * std::sin(angle);
    inside += u >= 0.0 && v >= 0.0 && u < size.width && v < size.height ? 1 : 0;
  }
  return static_cast<double>(inside) / kRays;
}

/** Moves a circle onto the edges near it, less and less of them; says how many rays agree. */
int settle(const std::vector<RayEdges> &rays, double unit, Circle &circle)
{
  int agreeing = 0;
  for (const double reach : {3.0, 2.0, 1.2, 1.0, 1.0, 1.0}) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    agreeing = 0;
    for (const RayEdges &edges : rays) {
      double nearest = reach * unit;
      Eigen::Vector3d row = Eigen::Vector3d::Zero();
      for (const Eigen::Vector2d &edge : edges) {
        const Eigen::Vector2d out = edge - circle.centre;
        const double off = out.norm() - circle.radius;
        if (std::abs(off) < std::abs(nearest)) {
          nearest = off;
          row << out.normalized(), 1.0;
        }
      }
      if (!row.isZero()) {
        A += row * row.transpose();
        b += nearest * row;
        ++agreeing;
      }
    }
    if (agreeing < kRays / 8) {
      return 0;
    }
    const Eigen::Vector3d move = A.ldlt().solve(b);
    circle.centre += move.head<2>();
    circle.radius += move.z();
  }
  return agreeing;
}

/** Radii at which the edges pile up, seen from a centre; those with many of them. */
void vote(const std::vector<RayEdges> &rays, const Eigen::Vector2d &centre, double unit,
          const cv::Size &size, std::vector<SupportedCircle> &candidates)
{
  const auto bins = static_cast<std::size_t>(std::max(size.width, size.height) / unit) + 2;
  std::vector<int> counts(bins, 0);
  for (const RayEdges &edges : rays) {
    for (const Eigen::Vector2d &edge : edges) {
      ++counts[std::min(bins - 1, static_cast<std::size_t>((edge - centre).norm() / unit))];
    }
  }
  const double smallest = 0.06 * std::min(size.width, size.height);
  for (std::size_t i = 1; i + 1 < bins; ++i) {
    const Circle circle{centre, (static_cast<double>(i) + 0.5) * unit};
    if (circle.radius < smallest || counts[i] < kRays / 10) {
      continue;
    }
    const double share = shown(circle, size);
    const double support = (counts[i] + 0.5 * (counts[i - 1] + counts[i + 1])) / (share * kRays);
    if (share > 0.3 && support > 0.3) {
      candidates.push_back({circle, support});
    }
  }
}

bool alike(const Circle &a, const Circle &b, double unit)
{
  return std::abs(a.radius - b.radius) + (a.centre - b.centre).norm() < 6.0 * unit;
}

} // namespace

std::vector<SupportedCircle> searchCircles(const cv::Mat1b &smooth)
{
  const Eigen::Vector2d middle((smooth.cols - 1) / 2.0, (smooth.rows - 1) / 2.0);
  const double unit = 0.006 * std::min(smooth.cols, smooth.rows); // of votes, pixels
  std::vector<RayEdges> rays;
  rays.reserve(kRays);
  for (int i = 0; i < kRays; ++i) {
    rays.push_back(edgesAlong(smooth, middle, 2.0 * kPi * i / kRays, 0.5 * unit));
  }
  std::vector<SupportedCircle> candidates;
  constexpr int kShifts = 15; // how far the mirror may be off the middle, in steps of 1.5 units
  for (int dx = -kShifts; dx <= kShifts; ++dx) {
    for (int dy = -kShifts; dy <= kShifts; ++dy) {
      vote(rays, middle + 1.5 * unit * Eigen::Vector2d(dx, dy), unit, smooth.size(), candidates);
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto &a, const auto &b) { return a.support > b.support; });
  std::vector<SupportedCircle> circles;
  for (const SupportedCircle &candidate : candidates) {
    if (circles.size() >= kCircles) {
      break;
    }
    const auto known = [&](const SupportedCircle &other) {
      return alike(other.circle, candidate.circle, unit);
    };
    if (std::any_of(circles.begin(), circles.end(), known)) {
      continue;
    }
    SupportedCircle settled = candidate;
    const int agreeing = settle(rays, unit, settled.circle);
    settled.support =
        std::min(1.0, agreeing / (kRays * std::max(0.1, shown(settled.circle, smooth.size()))));
    if (agreeing > 0 && !std::any_of(circles.begin(), circles.end(), [&](const auto &other) {
          return alike(other.circle, settled.circle, unit);
        })) {
      circles.push_back(settled);
    }
  }
  return circles;
}

} // namespace homeward
