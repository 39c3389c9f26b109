// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/laser_model.h>

#include "lift.h"
#include "random_streams.h"

#include <homeward/core/error.h>

#include <cmath>

namespace homeward
{

namespace
{

constexpr double kTiny = 1e-9; // radians

void check(const LaserOptions &options)
{
  const bool angles = options.step > 0.0 && options.step <= options.fieldOfView &&
                      options.fieldOfView <= 2.0 * kPi + kTiny;
  const bool rates = options.dropOutRate >= 0.0 && options.faultRate >= 0.0;
  if (!angles || !rates || !(options.rangeMax > 0.0) || !(options.sigma >= 0.0)) {
    throw LogicError("LaserOptions: need 0 < step <= fieldOfView <= 2 pi, rangeMax > 0, sigma and "
                     "rates >= 0, got step " +
                     std::to_string(options.step) + ", fieldOfView " +
                     std::to_string(options.fieldOfView) + ", rangeMax " +
                     std::to_string(options.rangeMax));
  }
}

/** Readings in a sweep; both ends are read unless the sweep closes the circle. */
std::size_t countOf(const LaserOptions &options)
{
  const auto steps =
      static_cast<std::size_t>(std::floor(options.fieldOfView / options.step + 1e-6));
  return options.fieldOfView > 2.0 * kPi - options.step / 2.0 ? steps : steps + 1;
}

} // namespace

LaserModel::LaserModel(SolidWorld world, const Eigen::Isometry3d &rMl, const LaserOptions &options,
                       std::uint64_t seed)
    : m_world(std::move(world)), m_rMl(rMl), m_options(options),
      m_random(seed, static_cast<std::uint32_t>(RandomStream::Laser))
{
  check(options);
  const std::size_t count = countOf(options);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = -options.fieldOfView / 2.0 + static_cast<double>(i) * options.step;
    m_rays.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
}

Scan LaserModel::measure(Time stamp, const Pose2 &wMr)
{
  const Eigen::Isometry3d wMl = lift(wMr) * m_rMl;
  const Eigen::Vector3f origin = wMl.translation().cast<float>();
  Scan scan;
  scan.stamp = stamp;
  scan.angleMin = -m_options.fieldOfView / 2.0;
  scan.angleStep = m_options.step;
  scan.rangeMax = m_options.rangeMax;
  scan.ranges.reserve(m_rays.size());
  for (const Eigen::Vector3d &ray : m_rays) {
    const Eigen::Vector3d direction = wMl.linear() * ray;
    scan.ranges.push_back(read(
        m_world.range(origin, direction.cast<float>(), static_cast<float>(m_options.rangeMax))));
  }
  return scan;
}

float LaserModel::read(double range)
{
  // Always the same number of draws, so that one fault does not change every later reading.
  const double luck = m_random.uniform(0.0, 1.0);
  const double noise = m_random.normal(1.0);
  if (luck < m_options.dropOutRate) {
    return kUnknownRange;
  }
  if (luck < m_options.dropOutRate + m_options.faultRate / 2.0) {
    return static_cast<float>(m_options.nearFault * std::min(std::abs(noise) / 4.0, 1.0));
  }
  if (luck < m_options.dropOutRate + m_options.faultRate) {
    return static_cast<float>(m_options.farFault + 0.1 * noise);
  }
  const double measured = range + m_options.sigma * noise;
  return static_cast<float>(std::clamp(measured, 0.0, m_options.rangeMax));
}

} // namespace homeward
