// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/visp_base/base_robot.h>

#include <homeward/core/error.h>

#include <visp3/core/vpRotationMatrix.h>
#include <visp3/core/vpRxyzVector.h>
#include <visp3/core/vpTranslationVector.h>
#include <visp3/robot/vpRobotException.h>

#include <cmath>

namespace homeward
{

namespace
{

void expectReferenceFrame(vpRobot::vpControlFrameType frame)
{
  if (frame != vpRobot::REFERENCE_FRAME) {
    throw vpRobotException(vpRobotException::wrongStateError,
                           "BaseRobot knows vpRobot::REFERENCE_FRAME only");
  }
}

} // namespace

BaseRobot::BaseRobot(MobileBase &base) : m_base(base), m_displacedFrom(base.state().odometry)
{
  init();
}

BaseRobot::~BaseRobot()
{
  try {
    m_base.drive({});
  }
  catch (const DeviceError &) {
    // It is gone and does not drive.
  }
}

void BaseRobot::init()
{
  nDof = 2;
  vpMatrix jacobian(6, 2);
  jacobian[0][0] = 1.0;
  jacobian[5][1] = 1.0;
  set_eJe(jacobian);
  eJe = jacobian;
  eJeAvailable = 1;
}

void BaseRobot::setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &velocity)
{
  expectReferenceFrame(frame);
  if (velocity.size() != 2 || !std::isfinite(velocity[0]) || !std::isfinite(velocity[1])) {
    throw vpRobotException(vpRobotException::dimensionError,
                           "BaseRobot takes two finite velocities, v and w");
  }
  vpColVector most(2);
  most[0] = getMaxTranslationVelocity();
  most[1] = getMaxRotationVelocity();
  const vpColVector within = saturateVelocities(velocity, most);
  m_base.drive({within[0], within[1]});
}

vpColVector BaseRobot::getVelocity(const vpRobot::vpControlFrameType frame)
{
  expectReferenceFrame(frame);
  const Twist2 measured = m_base.state().velocity;
  vpColVector velocity(2);
  velocity[0] = measured.v;
  velocity[1] = measured.w;
  return velocity;
}

void BaseRobot::getPosition(const vpRobot::vpControlFrameType frame, vpColVector &position)
{
  expectReferenceFrame(frame);
  const Pose2 pose = m_base.state().odometry;
  const vpHomogeneousMatrix oMe(vpTranslationVector(pose.x, pose.y, 0.0),
                                vpRotationMatrix(vpRxyzVector(0.0, 0.0, pose.heading)));
  const vpHomogeneousMatrix oMc = oMe * get_cMe().inverse();
  const vpRxyzVector turns(oMc.getRotationMatrix());
  position.resize(6);
  for (unsigned int i = 0; i < 3; ++i) {
    position[i] = oMc[i][3];
    position[i + 3] = turns[i];
  }
}

void BaseRobot::getDisplacement(const vpRobot::vpControlFrameType frame, vpColVector &displacement)
{
  expectReferenceFrame(frame);
  const Pose2 now = m_base.state().odometry;
  const Pose2 moved = m_displacedFrom.inverse() * now;
  m_displacedFrom = now;
  displacement.resize(3);
  displacement[0] = moved.x;
  displacement[1] = moved.y;
  displacement[2] = moved.heading;
}

void BaseRobot::get_fJe(vpMatrix &jacobian)
{
  const double heading = m_base.state().odometry.heading;
  jacobian.resize(6, 2);
  jacobian[0][0] = std::cos(heading);
  jacobian[1][0] = std::sin(heading);
  jacobian[5][1] = 1.0;
}

vpRobot::vpRobotStateType BaseRobot::setRobotState(const vpRobot::vpRobotStateType state)
{
  if (state == vpRobot::STATE_STOP) {
    m_base.drive({});
  }
  return vpRobot::setRobotState(state);
}

void BaseRobot::setPosition(const vpRobot::vpControlFrameType /*frame*/,
                            const vpColVector & /*position*/)
{
  throw vpRobotException(vpRobotException::wrongStateError,
                         "BaseRobot goes nowhere by itself; drive it by setVelocity()");
}

} // namespace homeward
