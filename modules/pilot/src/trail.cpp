// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/trail.h>

#include <homeward/core/angle.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

constexpr double kStep = 0.08; // metres between poses, ...
constexpr double kTurn = 0.2;  // or radians
constexpr std::size_t kMost = 80;

} // namespace

void Trail::add(const Pose2 &oMr)
{
  if (!m_poses.empty()) {
    const Pose2 moved = m_poses.back().inverse() * oMr;
    if (moved.translation().norm() < kStep && std::abs(moved.heading) < kTurn) {
      return;
    }
  }
  m_poses.push_back(oMr);
  if (m_poses.size() > kMost) {
    m_poses.pop_front();
  }
}

std::optional<Twist2> Trail::wayBack(const Pose2 &oMr)
{
  constexpr double kSpeed = 0.15;      // m/s
  constexpr double kRate = 0.4;        // rad/s
  constexpr double kReached = 0.05;    // metres
  constexpr double kAligned = 0.15;    // radians
  constexpr double kPassed = 0.15;     // metres beyond a pose that is behind the robot no more
  constexpr double kOffTheTrail = 0.4; // metres
  while (!m_poses.empty()) {
    const Pose2 target = oMr.inverse() * m_poses.back();
    const double distance = target.translation().norm();
    if (distance > kOffTheTrail) {
      m_poses.clear();
      break;
    }
    const bool passed = target.x > 0.0 && distance < kPassed;
    if (distance > kReached && !passed) {
      if (target.x > 0.0) {
        m_poses.clear();
        break;
      }
      // The arc through the pose, tangential to the robot's heading.
      const double curvature = 2.0 * target.y / (distance * distance);
      return Twist2{-kSpeed, std::clamp(-kSpeed * curvature, -kRate, kRate)};
    }
    if (std::abs(target.heading) > kAligned) {
      return Twist2{0.0, std::copysign(kRate, target.heading)};
    }
    m_poses.pop_back();
  }
  return std::nullopt;
}

} // namespace homeward
