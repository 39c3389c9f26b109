// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/mount.h>

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace homeward
{

/** One bearing, with landmarks counted from 0. */
struct Sight
{
  std::size_t place; ///< of the drive
  Eigen::Index landmark;
  double bearing;
};

/** Mount (x, y, heading), how much more each step turned than odometry says, and landmarks. */
using Unknowns = Eigen::VectorXd;

constexpr Eigen::Index kMount = 3;

/** The odometry of a drive as steps from place to place. */
class Way
{
public:
  explicit Way(const std::vector<MountSample> &drive)
  {
    for (std::size_t i = 0; i < drive.size(); ++i) {
      m_steps.push_back(i == 0 ? drive[0].oMr : drive[i - 1].oMr.inverse() * drive[i].oMr);
    }
  }

  /** Unknowns that come before the landmarks: the mount's and one a step. */
  Eigen::Index own() const { return kMount + static_cast<Eigen::Index>(m_steps.size()) - 1; }

  std::vector<Pose2> places(const Unknowns &x) const
  {
    std::vector<Pose2> result;
    for (const Pose2 &step : m_steps) {
      const auto i = static_cast<Eigen::Index>(result.size());
      result.push_back(
          i == 0 ? step : result.back() * Pose2{step.x, step.y, step.heading + x[kMount + i - 1]});
    }
    return result;
  }

  /** The unknowns of a camera in the robot's middle, where every turn is a share longer. */
  Unknowns start(double yaw, double slip) const
  {
    Unknowns x = Unknowns::Zero(own());
    x[2] = yaw;
    for (std::size_t i = 1; i < m_steps.size(); ++i) {
      x[kMount + static_cast<Eigen::Index>(i) - 1] = slip * m_steps[i].heading;
    }
    return x;
  }

  /** Standard deviation of what a step turns more: wheels that skid, and a little in any case. */
  double sigma(Eigen::Index step) const
  {
    constexpr double kShare = 0.1;
    constexpr double kLeast = 0.002; // radians
    return kLeast + kShare * std::abs(m_steps[static_cast<std::size_t>(step) + 1].heading);
  }

private:
  std::vector<Pose2> m_steps; ///< the first one is a place
};

/** What was seen on the way. */
struct Seen
{
  Way way;
  std::vector<Sight> sights;
};

/**
 * The start with landmarks where their sights cross. What was seen on the spot alone crosses in the
 * camera itself: a weak belief puts it some metres away.
 */
Unknowns crossed(const Seen &seen, int landmarks, const Unknowns &start);

/** Standard deviation of the bearings' errors but for a few, radians. */
double scaleOf(const Seen &seen, const Unknowns &x);

/** Levenberg-Marquardt with Huber's weights, so many steps at most. */
Unknowns refined(const Seen &seen, Unknowns x, int steps);

/** How well the mount is known where sights err independently. */
struct MountSpread
{
  Eigen::Matrix3d covariance; ///< of x, y (metres) and heading (radians)
  double rms = 0.0;           ///< of the bearings, radians
};

/** @param scale as scaleOf() */
MountSpread spreadOf(const Seen &seen, const Unknowns &x, double scale);

} // namespace homeward
