// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/sonar_model.h>

#include "lift.h"
#include "random_streams.h"

#include <homeward/sim/collision_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace homeward
{

namespace
{

/** A ray of the cone, radians off its axis. */
struct ConeRay
{
  double aside;
  double up;
};

constexpr std::array<ConeRay, 7> kCone{{{0.0, 0.0},
                                        {radians(-7.0), 0.0},
                                        {radians(7.0), 0.0},
                                        {radians(-14.0), 0.0},
                                        {radians(14.0), 0.0},
                                        {0.0, radians(-10.0)},
                                        {0.0, radians(10.0)}}};
constexpr double kSigma = 0.01; // metres

} // namespace

SonarModel::SonarModel(SolidWorld world, const RobotDescription &robot, std::uint64_t seed)
    : m_world(std::move(world)), m_mounts(robot.sonars),
      m_random(seed, static_cast<std::uint32_t>(RandomStream::Sonar))
{}

std::vector<SonarEcho> SonarModel::measure(const Pose2 &wMr)
{
  const Eigen::Isometry3d spatial = lift(wMr);
  std::vector<SonarEcho> echoes;
  echoes.reserve(m_mounts.size());
  for (const SonarMount &mount : m_mounts) {
    const double range = nearest(mount, spatial) + m_random.normal(kSigma);
    const bool heard = range <= kRangeMax;
    echoes.push_back({mount.bearing, mount.x, mount.y,
                      heard ? std::max(range, 0.0) : std::numeric_limits<double>::quiet_NaN()});
  }
  return echoes;
}

double SonarModel::nearest(const SonarMount &mount, const Eigen::Isometry3d &wMr) const
{
  const Eigen::Vector3d origin = wMr * Eigen::Vector3d(mount.x, mount.y, mount.z);
  double shortest = std::numeric_limits<double>::infinity();
  for (const ConeRay &ray : kCone) {
    const double angle = mount.bearing + ray.aside;
    const Eigen::Vector3d direction =
        wMr.linear() * Eigen::Vector3d(std::cos(angle) * std::cos(ray.up),
                                       std::sin(angle) * std::cos(ray.up), std::sin(ray.up));
    const double range = m_world.range(origin.cast<float>(), direction.cast<float>(),
                                       static_cast<float>(kRangeMax) + 1.0F);
    // The floor, met at a grazing angle, sends nothing back.
    if (origin.z() + range * direction.z() > kDriveableHeight) {
      shortest = std::min(shortest, range);
    }
  }
  return shortest;
}

} // namespace homeward
