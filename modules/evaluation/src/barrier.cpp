// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/barrier.h>

#include "person.h"

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

constexpr double kWidest = 3.0;      // metres
constexpr double kNarrowest = 1.0;   // metres
constexpr double kShortestWay = 1.3; // metres
constexpr double kClear = 0.5;       // metres round a place

} // namespace

double Barrier::distanceTo(const Eigen::Vector2d &point) const
{
  const Eigen::Vector2d here = middle.inverse() * point;
  const Eigen::Vector2d half(0.5 * kThickness, 0.5 * width);
  return (here.cwiseAbs() - half).cwiseMax(0.0).norm();
}

std::shared_ptr<const Scene> Barrier::scene() const
{
  const Eigen::Vector3f half = 0.5F * Eigen::Vector3d(kThickness, width, kHeight).cast<float>();
  const Eigen::Vector3f up(0.0F, 0.0F, half.z());
  const Eigen::Affine3f wMb =
      Eigen::Translation3f(static_cast<float>(middle.x), static_cast<float>(middle.y), 0.0F) *
      Eigen::AngleAxisf(static_cast<float>(middle.heading), Eigen::Vector3f::UnitZ());
  Scene scene;
  scene.name = "barrier";
  scene.materials.push_back({{0.45F, 0.3F, 0.15F}});
  addSolidBox(scene, "barrier", {up - half, up + half}, 0, wMb);
  return std::make_shared<const Scene>(std::move(scene));
}

std::optional<Barrier> barrierAcross(const Eigen::Vector2d &from, const Eigen::Vector2d &to,
                                     const std::vector<Eigen::Vector2d> &clear)
{
  const Eigen::Vector2d way = to - from;
  const Eigen::Vector2d middle = 0.5 * (from + to);
  Barrier barrier{{middle.x(), middle.y(), std::atan2(way.y(), way.x())}, kWidest};
  for (const Eigen::Vector2d &place : clear) {
    const Eigen::Vector2d off = (barrier.middle.inverse() * place).cwiseAbs();
    const double along = std::max(0.0, off.x() - 0.5 * Barrier::kThickness);
    if (along < kClear) {
      const double across = std::sqrt(kClear * kClear - along * along);
      barrier.width = std::min(barrier.width, 2.0 * (off.y() - across));
    }
  }
  const bool fits = way.norm() >= kShortestWay && barrier.width >= kNarrowest;
  return fits ? std::optional(barrier) : std::nullopt;
}

} // namespace homeward
