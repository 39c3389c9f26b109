// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_lines.h"

#include <homeward/core/angle.h>
#include <homeward/core/symmetric_eigen.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace homeward
{
namespace
{

constexpr double kNoise = 1.0;            ///< pixels; an edge that bends more is none
constexpr double kUpright = radians(4.0); ///< a plane so near the axis is a vertical's
constexpr double kFar = 1e3;              ///< pixels
constexpr double kXiMin = 0.5;
constexpr double kXiMax = 2.2;
constexpr double kRimMin = radians(0.0);
constexpr double kRimMax = radians(50.0);

/** The rays of a chain, or of every few of its pixels. */
std::vector<Eigen::Vector3d> raysOf(const UnifiedCamera &camera, const EdgeChain &chain)
{
  const std::size_t step = std::max<std::size_t>(1, chain.size() / 24);
  std::vector<Eigen::Vector3d> rays;
  for (std::size_t i = 0; i < chain.size(); i += step) {
    if (const auto ray = camera.unproject(chain[i])) {
      rays.push_back(*ray);
    }
  }
  return rays;
}

/**
 * Normal of the plane through the sphere's centre nearest to the rays; of those planes that hold
 * the axis, if asked.
 */
Eigen::Vector3d planeOf(const std::vector<Eigen::Vector3d> &rays, bool throughAxis)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d &ray : rays) {
    sum += ray * ray.transpose();
  }
  if (!throughAxis) {
    return symmetricEigen(sum).vectors.col(0);
  }
  const Eigen::MatrixXd vectors = symmetricEigen(sum.topLeftCorner<2, 2>()).vectors;
  return {vectors(0, 0), vectors(1, 0), 0.0};
}

/** How far from a plane's image the picture shows a ray, pixels. */
double asidePx(const UnifiedCamera &camera, const Eigen::Vector3d &normal,
               const Eigen::Vector3d &ray)
{
  UnifiedCamera::PointJacobian J;
  return camera.project(ray, &J) ? normal.dot(ray) * (J * normal).norm() : kFar;
}

/** How far a chain bends, rms, pixels; a vertical one is held against the axis. */
double bendOf(const UnifiedCamera &camera, const EdgeChain &chain)
{
  const std::vector<Eigen::Vector3d> rays = raysOf(camera, chain);
  if (rays.size() < 8) {
    return kFar;
  }
  Eigen::Vector3d normal = planeOf(rays, false);
  if (std::abs(normal.z()) < std::sin(kUpright)) {
    normal = planeOf(rays, true);
  }
  double sum = 0.0;
  for (const Eigen::Vector3d &ray : rays) {
    const double aside = asidePx(camera, normal, ray);
    sum += aside * aside;
  }
  return std::sqrt(sum / static_cast<double>(rays.size()));
}

/** Index of the pixel farthest from the plane of its chain, and how far, pixels. */
std::pair<std::size_t, double> farthest(const UnifiedCamera &camera, const EdgeChain &chain)
{
  const Eigen::Vector3d normal = planeOf(raysOf(camera, chain), false);
  std::pair<std::size_t, double> worst{chain.size() / 2, 0.0};
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto ray = camera.unproject(chain[i]);
    const double off = ray ? std::abs(asidePx(camera, normal, *ray)) : kFar;
    if (off > worst.second) {
      worst = {i, off};
    }
  }
  return worst;
}

/**
 * What speaks against a shape before any line is seen: mirrors have an xi near 1, and their rim
 * lies round the axis.
 */
double doubt(const MirrorShape &shape, const Circle &rim)
{
  const double xi = (shape.xi - 1.0) / 0.2;
  const double shift = (shape.mirror.outer.centre - rim.centre).norm() / (0.01 * rim.radius);
  return 0.008 * (xi * xi + shift * shift);
}

bool possible(const MirrorShape &shape)
{
  return shape.xi >= kXiMin && shape.xi <= kXiMax && shape.rimElevation >= kRimMin &&
         shape.rimElevation <= kRimMax &&
         std::sin(shape.rimElevation) < std::min(shape.xi - 0.1, 0.98 / shape.xi);
}

} // namespace

UnifiedCamera MirrorShape::camera(const cv::Size &size) const
{
  const double angle = kPi / 2.0 + rimElevation; // from the axis
  UnifiedCamera::Parameters parameters;
  parameters.xi = xi;
  parameters.fx = mirror.outer.radius * (std::cos(angle) + xi) / std::sin(angle);
  parameters.fy = parameters.fx;
  parameters.cx = mirror.outer.centre.x();
  parameters.cy = mirror.outer.centre.y();
  return {parameters, size.width, size.height};
}

SceneLines::SceneLines(const std::vector<cv::Mat1b> &pictures, const MirrorCircles &mirror)
    : m_size(pictures[0].size()), m_rim(mirror.outer),
      m_shortest(static_cast<int>(0.11 * mirror.outer.radius))
{
  MirrorCircles within = mirror; // the ring's own borders are no edges of the scene
  within.outer.radius -= 4.0 + 0.01 * mirror.outer.radius;
  within.inner.radius += 4.0 + 0.01 * mirror.outer.radius;
  const cv::Mat mask = mirrorMask(within, m_size.width, m_size.height);
  for (const cv::Mat1b &picture : pictures) {
    auto chains = findEdgeChains(picture, mask, m_shortest);
    m_chains.insert(m_chains.end(), chains.begin(), chains.end());
  }
}

double SceneLines::cost(const MirrorShape &shape, const std::vector<EdgeChain> &chains) const
{
  if (!possible(shape)) {
    return 1e9;
  }
  const UnifiedCamera camera = shape.camera(m_size);
  double sum = 0.0;
  double weight = 0.0;
  for (const EdgeChain &chain : chains) {
    const double bend = bendOf(camera, chain) / kNoise;
    const auto length = static_cast<double>(chain.size());
    sum += length * bend * bend / (1.0 + bend * bend);
    weight += length;
  }
  return sum / weight + doubt(shape, m_rim);
}

std::vector<EdgeChain> SceneLines::straightPieces(const MirrorShape &shape) const
{
  constexpr double kCut = 3.0; // pixels; a chain that runs round a corner is two
  const UnifiedCamera camera = shape.camera(m_size);
  std::vector<EdgeChain> pieces;
  std::vector<EdgeChain> waiting = m_chains;
  while (!waiting.empty()) {
    const EdgeChain chain = std::move(waiting.back());
    waiting.pop_back();
    if (static_cast<int>(chain.size()) < m_shortest) {
      continue;
    }
    const auto [index, off] = farthest(camera, chain);
    if (off < kCut) {
      pieces.push_back(chain);
      continue;
    }
    const auto cut = chain.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(
                                         index, chain.size() / 4, 3 * chain.size() / 4));
    waiting.emplace_back(chain.begin(), cut);
    waiting.emplace_back(cut, chain.end());
  }
  return pieces;
}

MirrorShape SceneLines::refine(MirrorShape shape, const std::vector<EdgeChain> &chains, bool freeXi,
                               bool freeRim) const
{
  // One parameter after the other, in steps that shrink: the cost has kinks, a simplex gets stuck.
  std::array<double, 4> steps{freeXi ? 0.1 : 0.0, freeRim ? radians(2.0) : 0.0, 2.0, 2.0};
  const auto moved = [](MirrorShape from, std::size_t which, double step) {
    switch (which) {
    case 0:
      from.xi += step;
      break;
    case 1:
      from.rimElevation += step;
      break;
    case 2:
      from.mirror.outer.centre.x() += step;
      break;
    default:
      from.mirror.outer.centre.y() += step;
      break;
    }
    return from;
  };
  double best = cost(shape, chains);
  for (int round = 0; round < 60; ++round) {
    for (std::size_t which = 0; which < steps.size(); ++which) {
      if (steps[which] == 0.0) {
        continue;
      }
      bool better = false;
      for (const double sign : {1.0, -1.0}) {
        const MirrorShape tried = moved(shape, which, sign * steps[which]);
        const double now = cost(tried, chains);
        if (now < best) {
          best = now;
          shape = tried;
          better = true;
          break;
        }
      }
      steps[which] *= better ? 1.2 : 0.6;
    }
  }
  return shape;
}

MirrorShape SceneLines::bestRim(MirrorShape shape) const
{
  double least = cost(shape, m_chains);
  MirrorShape best = shape;
  for (double rim = kRimMin; rim <= kRimMax; rim += radians(2.0)) {
    shape.rimElevation = rim;
    const double now = cost(shape, m_chains);
    if (now < least) {
      least = now;
      best = shape;
    }
  }
  return best;
}

bool SceneLines::tellsXi(const MirrorShape &shape, bool freeRim) const
{
  constexpr double kAside = 0.2;
  constexpr double kClear = 0.25; // of the cost
  const double here = cost(shape, m_chains);
  for (const double sign : {-1.0, 1.0}) {
    MirrorShape other = shape;
    other.xi += sign * kAside;
    other = freeRim ? bestRim(other) : other;
    if (cost(other, m_chains) < (1.0 + kClear) * here) {
      return false;
    }
  }
  return true;
}

SceneLines::Fit SceneLines::fit(const MirrorShape &start, bool freeXi, bool freeRim) const
{
  MirrorShape best = start;
  double least = 1e9;
  for (double xi = freeXi ? 0.6 : start.xi; xi < kXiMax; xi += freeXi ? 0.1 : kXiMax) {
    MirrorShape tried = start;
    tried.xi = xi;
    tried = freeRim ? bestRim(tried) : tried;
    const double now = cost(tried, m_chains);
    if (now < least) {
      least = now;
      best = tried;
    }
  }
  best = refine(best, m_chains, freeXi, freeRim);
  const std::vector<EdgeChain> pieces = straightPieces(best);
  Fit result;
  result.shape = refine(best, pieces, freeXi, freeRim);
  result.tellsXi = freeXi && tellsXi(result.shape, freeRim);
  const UnifiedCamera camera = result.shape.camera(m_size);
  double sum = 0.0;
  for (const EdgeChain &chain : pieces) {
    const double bend = bendOf(camera, chain);
    if (bend < 2.0 * kNoise) {
      sum += bend * bend;
      ++result.lines;
    }
  }
  result.rms = std::sqrt(sum / std::max(1, result.lines));
  return result;
}

} // namespace homeward
