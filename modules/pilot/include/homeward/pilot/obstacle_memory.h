// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/scan.h>
#include <homeward/robot/mobile_base.h>

#include <Eigen/Core>

#include <vector>

namespace homeward
{

/**
 * Obstacles near the robot: what the laser sees now, what it saw a moment ago beside and behind,
 * echoes of the sonar, and places where the body was held by something no sensor saw. Kept in the
 * odometry frame, for a few metres and seconds only, while odometry is good.
 */
class ObstacleMemory
{
public:
  /** How long and how far obstacles are believed. */
  struct Options
  {
    double reach = 3.0;         ///< metres from the robot's centre; farther points are forgotten
    double keepSeconds = 25.0;  ///< how long an unseen point is believed
    double keepContact = 300.0; ///< seconds a place of contact is believed
    double sonarReach = 0.3;    ///< metres; the place of a longer echo is too vague to pass doors
  };

  /** Believes in nothing at first. */
  explicit ObstacleMemory(const Options &options);

  /**
   * Takes a new scan: what the scan looks at is replaced, the rest is kept.
   * @param scan in the laser's frame
   * @param rMl the laser in the robot's frame, planar
   * @param oMr the robot in the odometry frame when the scan was taken
   */
  void update(const Scan &scan, const Pose2 &rMl, const Pose2 &oMr);

  /** Takes the newest echoes. */
  void update(const std::vector<SonarEcho> &echoes, const Pose2 &oMr, Time now);

  /** Remembers that something unseen stands at a point of the odometry frame, metres. */
  void addContact(const Eigen::Vector2d &oP, Time now);

  /** Gives up the guesses that contacts led to. */
  void forgetContacts() { m_contacts.clear(); }

  /** What laser and sonar saw, in the robot's frame, metres. */
  std::vector<Eigen::Vector2d> sensed(const Pose2 &oMr) const;

  /** Everything believed, contacts too, in the robot's frame, metres. */
  std::vector<Eigen::Vector2d> points(const Pose2 &oMr) const;

private:
  struct Believed
  {
    Eigen::Vector2d oP;
    Time until;
  };

  Options m_options;
  std::vector<Eigen::Vector2d> m_seen; ///< by the newest scan, odometry frame
  std::vector<Believed> m_remembered;  ///< out of the laser's sight now
  std::vector<Believed> m_echoes;
  std::vector<Believed> m_contacts;
};

} // namespace homeward
