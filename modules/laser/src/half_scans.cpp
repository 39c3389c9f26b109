// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/laser/half_scans.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace homeward
{
namespace
{

constexpr std::size_t kBins = 360;
constexpr double kNear = 0.10; // metres; below, the sensor is at fault

/** A reading as seen from the merged frame's origin. */
struct Seen
{
  double angle;
  double range;
};

std::size_t binOf(double angle)
{
  const auto bin = static_cast<long>(std::lround(degrees(angle))) + 180;
  return static_cast<std::size_t>((bin + 360) % 360);
}

std::optional<Seen> seen(const PlacedScan &placed, const Eigen::Isometry3d &rMl, std::size_t i)
{
  const Scan &scan = placed.scan;
  const double range = scan.ranges[i];
  if (!(range >= kNear)) {
    return std::nullopt;
  }
  const double angle = scan.angle(i);
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.0);
  if (range >= scan.rangeMax) {
    const Eigen::Vector3d r = rMl.linear() * along;
    return Seen{wrapAngle(std::atan2(r.y(), r.x()) + placed.mMr.heading), scan.rangeMax};
  }
  const Eigen::Vector3d rP = rMl * (range * along);
  const Eigen::Vector2d mP = placed.mMr * Eigen::Vector2d(rP.head<2>());
  return Seen{std::atan2(mP.y(), mP.x()), mP.norm()};
}

void take(Scan &joined, const Seen &reading)
{
  float &bin = joined.ranges[binOf(reading.angle)];
  const auto range = static_cast<float>(reading.range);
  bin = std::isnan(bin) ? range : std::min(bin, range);
}

/** Gives the unknown bins between two neighbouring readings what lies between them. */
void fill(Scan &joined, const Seen &a, const Seen &b)
{
  constexpr double kWidest = radians(3.0);
  constexpr double kJump = 0.3; // metres; beyond, there is an edge and no surface between
  const double span = wrapAngle(b.angle - a.angle);
  if (std::abs(span) > kWidest) {
    return;
  }
  const int steps = static_cast<int>(std::ceil(degrees(std::abs(span)) * 2.0));
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double between = std::abs(b.range - a.range) < kJump
                               ? a.range + share * (b.range - a.range)
                               : (share < 0.5 ? a.range : b.range);
    float &bin = joined.ranges[binOf(a.angle + share * span)];
    if (std::isnan(bin)) {
      bin = static_cast<float>(between);
    }
  }
}

} // namespace

Scan joinScans(const std::vector<PlacedScan> &scans, const Eigen::Isometry3d &rMl)
{
  if (scans.empty()) {
    throw LogicError("joinScans: needs a scan");
  }
  Scan joined{scans.front().scan.stamp, -kPi, radians(1.0), 0.0, {}};
  joined.ranges.assign(kBins, kUnknownRange);
  std::vector<std::vector<std::optional<Seen>>> readings;
  for (const PlacedScan &placed : scans) {
    joined.stamp = std::max(joined.stamp, placed.scan.stamp);
    joined.rangeMax = std::max(joined.rangeMax, placed.scan.rangeMax);
    auto &row = readings.emplace_back();
    for (std::size_t i = 0; i < placed.scan.ranges.size(); ++i) {
      row.push_back(seen(placed, rMl, i));
      if (row.back()) {
        take(joined, *row.back());
      }
    }
  }
  for (const auto &row : readings) {
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (row[i - 1] && row[i]) {
        fill(joined, *row[i - 1], *row[i]);
      }
    }
  }
  return joined;
}

} // namespace homeward
