// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/visp_base/visp_base.h>

#include <homeward/core/error.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpRotationMatrix.h>
#include <visp3/core/vpRxyzVector.h>
#include <visp3/core/vpTranslationVector.h>

#include <cmath>
#include <string>

namespace homeward
{

namespace
{

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

/** Does something with the robot; what it throws is a DeviceError for us. */
template <typename Action> auto asDevice(const Action &action)
{
  try {
    return action();
  }
  catch (const vpException &error) {
    throw DeviceError(std::string("the ViSP robot refuses: ") + error.getStringMessage());
  }
}

} // namespace

VispBase::VispBase(vpRobot &robot, const Clock &clock, const VispBaseOptions &options)
    : m_robot(robot), m_clock(clock), m_options(options), m_reckonedAt(clock.now())
{
  asDevice([&] { m_robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL); });
  m_state.stamp = m_reckonedAt;
  m_state.odometry = toldPose().value_or(m_reckoned);
}

void VispBase::drive(const Twist2 &twist)
{
  reckon();
  if (!m_options.velocity) {
    m_driven = twist;
  }
  vpColVector velocity(2);
  velocity[0] = twist.v;
  velocity[1] = twist.w;
  asDevice([&] { m_robot.setVelocity(m_options.frame, velocity); });
}

BaseState VispBase::state()
{
  reckon();
  const std::optional<Pose2> told = toldPose();
  const Pose2 pose = told.value_or(m_reckoned);
  const double seconds = toSeconds(m_reckonedAt - m_state.stamp);
  if (!told || m_options.velocity) {
    m_state.velocity = m_driven;
  }
  else if (seconds > 0.0) {
    const Pose2 moved = m_state.odometry.inverse() * pose;
    // The length of the arc, of which the way straight there is the chord.
    const double half = 0.5 * moved.heading;
    const double chord = std::copysign(moved.translation().norm(), moved.x);
    const double arc = std::abs(half) < 1e-6 ? chord : chord * half / std::sin(half);
    m_state.velocity = {arc / seconds, moved.heading / seconds};
  }
  m_state.stamp = m_reckonedAt;
  m_state.odometry = pose;
  return m_state;
}

std::optional<Pose2> VispBase::toldPose()
{
  return asDevice([&]() -> std::optional<Pose2> {
    vpColVector told;
    m_robot.getPosition(vpRobot::REFERENCE_FRAME, told);
    if (told.size() != 6) {
      return std::nullopt;
    }
    const vpHomogeneousMatrix oMc(vpTranslationVector(told[0], told[1], told[2]),
                                  vpRotationMatrix(vpRxyzVector(told[3], told[4], told[5])));
    const vpHomogeneousMatrix oMe = oMc * m_options.cMe;
    return Pose2{oMe[0][3], oMe[1][3], std::atan2(oMe[1][0], oMe[0][0])};
  });
}

std::optional<Twist2> VispBase::toldVelocity()
{
  if (!m_options.velocity) {
    return std::nullopt;
  }
  const vpColVector told = asDevice(m_options.velocity);
  if (told.size() != 2) {
    throw DeviceError("the ViSP robot tells " + std::to_string(told.size()) +
                      " velocities, not v and w");
  }
  return Twist2{told[0], told[1]};
}

void VispBase::reckon()
{
  const Time now = m_clock.now();
  m_reckoned = m_reckoned * integrate(m_driven, toSeconds(now - m_reckonedAt));
  m_driven = toldVelocity().value_or(m_driven);
  m_reckonedAt = now;
}

} // namespace homeward
