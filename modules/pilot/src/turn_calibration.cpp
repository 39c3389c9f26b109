// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/turn_calibration.h>

#include <homeward/core/angle.h>

#include <cmath>

namespace homeward
{

Pose2 TurnCalibration::follow(const Pose2 &raw)
{
  if (!m_raw) {
    m_pose = raw;
  }
  else {
    const Pose2 step = m_raw->inverse() * raw;
    const double turn = wrapAngle(step.heading);
    m_turned += turn;
    m_pose = m_pose * Pose2{step.x, step.y, (1.0 - m_share) * turn};
    m_pose.heading = wrapAngle(m_pose.heading);
  }
  m_raw = raw;
  return m_pose;
}

bool TurnCalibration::learn(double turned, double missing)
{
  constexpr double kView = radians(3.0); // what a view errs
  constexpr double kSlip = 0.02;         // share of a turn that the next one may slip more
  constexpr double kFloor = 0.005;       // the same of the share itself, from place to place
  constexpr double kGate = 3.0;          // sigmas
  m_variance += kFloor * kFloor;
  const double noise = kView * kView + kSlip * kSlip * turned * turned;
  const double spread = turned * turned * m_variance + noise;
  if (missing * missing > kGate * kGate * spread) {
    return false;
  }
  const double gain = -turned * m_variance / spread;
  m_share += gain * missing;
  m_variance *= noise / spread;
  return true;
}

} // namespace homeward
