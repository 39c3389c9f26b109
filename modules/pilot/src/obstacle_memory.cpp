// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/obstacle_memory.h>

#include <algorithm>

namespace homeward
{

ObstacleMemory::ObstacleMemory(const Options &options) : m_options(options) {}

void ObstacleMemory::update(const Scan &scan, const Pose2 &rMl, const Pose2 &oMr)
{
  const Pose2 oMl = oMr * rMl;
  const Pose2 lMo = oMl.inverse();
  const double first = scan.angleMin;
  const double last = scan.angle(scan.ranges.size()) - scan.angleStep;
  const auto inSight = [&](const Eigen::Vector2d &oP) {
    const Eigen::Vector2d lP = lMo * oP;
    const double angle = std::atan2(lP.y(), lP.x());
    return angle >= first && angle <= last;
  };
  const auto nearby = [&](const Eigen::Vector2d &oP) {
    return (oP - oMr.translation()).norm() < m_options.reach;
  };
  for (const Eigen::Vector2d &oP : m_seen) {
    m_remembered.push_back({oP, scan.stamp + fromSeconds(m_options.keepSeconds)});
  }
  std::erase_if(m_remembered, [&](const Believed &point) {
    return point.until < scan.stamp || !nearby(point.oP) || inSight(point.oP);
  });
  m_seen.clear();
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    if (!(range > 0.05) || range >= scan.rangeMax) {
      continue;
    }
    const double angle = scan.angle(i);
    const Eigen::Vector2d oP =
        oMl * Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle));
    if (nearby(oP)) {
      m_seen.push_back(oP);
    }
  }
}

void ObstacleMemory::update(const std::vector<SonarEcho> &echoes, const Pose2 &oMr, Time now)
{
  constexpr double kEchoSeconds = 1.0;
  std::erase_if(m_echoes, [&](const Believed &echo) { return echo.until < now; });
  for (const SonarEcho &echo : echoes) {
    if (echo.range > 0.0 && echo.range < m_options.sonarReach) {
      const Eigen::Vector2d rP(echo.x + echo.range * std::cos(echo.bearing),
                               echo.y + echo.range * std::sin(echo.bearing));
      m_echoes.push_back({oMr * rP, now + fromSeconds(kEchoSeconds)});
    }
  }
}

void ObstacleMemory::addContact(const Eigen::Vector2d &oP, Time now)
{
  std::erase_if(m_contacts, [&](const Believed &contact) { return contact.until < now; });
  m_contacts.push_back({oP, now + fromSeconds(m_options.keepContact)});
}

std::vector<Eigen::Vector2d> ObstacleMemory::sensed(const Pose2 &oMr) const
{
  const Pose2 rMo = oMr.inverse();
  std::vector<Eigen::Vector2d> points;
  points.reserve(m_seen.size() + m_remembered.size() + m_echoes.size() + m_contacts.size());
  for (const Eigen::Vector2d &oP : m_seen) {
    points.push_back(rMo * oP);
  }
  for (const auto *kind : {&m_remembered, &m_echoes}) {
    for (const Believed &point : *kind) {
      points.push_back(rMo * point.oP);
    }
  }
  return points;
}

std::vector<Eigen::Vector2d> ObstacleMemory::points(const Pose2 &oMr) const
{
  std::vector<Eigen::Vector2d> points = sensed(oMr);
  const Pose2 rMo = oMr.inverse();
  for (const Believed &contact : m_contacts) {
    points.push_back(rMo * contact.oP);
  }
  return points;
}

} // namespace homeward
