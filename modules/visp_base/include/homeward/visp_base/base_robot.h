// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/visp_base/visp_types.h>

namespace homeward
{

/**
 * Any MobileBase as a robot of ViSP: a unicycle, driven as `vpRobotPioneer` is. Its end effector
 * frame e is the robot's (x forward, y left, z up); set_cMe() says where a camera sits on it, at
 * first in e. Errors of the base come through as DeviceError, wrong use as vpRobotException.
 */
class BaseRobot : public vpRobot, public vpUnicycle
{
public:
  /** @param base must outlive this */
  explicit BaseRobot(MobileBase &base);

  /** Stops the base, if it still can. */
  ~BaseRobot() override;
  BaseRobot(const BaseRobot &) = delete;
  BaseRobot &operator=(const BaseRobot &) = delete;

  /**
   * Drives.
   * @param frame REFERENCE_FRAME
   * @param velocity (v, w), m/s forward and rad/s counter-clockwise; scaled down where it is above
   * getMaxTranslationVelocity() or getMaxRotationVelocity(), at first 0.2 m/s and 0.7 rad/s
   * @throw vpRobotException for another frame, size or a value that is not finite
   */
  void setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &velocity) override;

  /** The measured velocity. As setVelocity(). */
  vpColVector getVelocity(const vpRobot::vpControlFrameType frame);

  using vpRobot::getPosition;

  /**
   * The camera in the odometry frame, as `vpSimulatorPioneer` gives it: x, y, z in metres, then
   * rotations about x, y, z (vpRxyzVector) in radians.
   * @param frame REFERENCE_FRAME
   * @throw vpRobotException for another frame
   */
  void getPosition(const vpRobot::vpControlFrameType frame, vpColVector &position) override;

  /**
   * How the robot has moved since the call before, or since it was made: x, y in metres, turn in
   * radians, in the frame of the robot as it stood then.
   * @param frame REFERENCE_FRAME
   * @throw vpRobotException for another frame
   */
  void getDisplacement(const vpRobot::vpControlFrameType frame, vpColVector &displacement) override;

  using vpUnicycle::get_eJe;

  /** 6 x 2: velocity of e, in e, of (v, w). */
  void get_eJe(vpMatrix &jacobian) override { jacobian = get_eJe(); }

  /** 6 x 2: velocity of e, in the odometry frame, of (v, w). */
  void get_fJe(vpMatrix &jacobian) override;

  /** STATE_STOP stops the base. */
  vpRobot::vpRobotStateType setRobotState(const vpRobot::vpRobotStateType state) override;

  /** Not possible. @throw vpRobotException always */
  void setPosition(const vpRobot::vpControlFrameType frame, const vpColVector &position) override;

private:
  void init() override;

  MobileBase &m_base;
  Pose2 m_displacedFrom; ///< odometry at the last getDisplacement()
};

} // namespace homeward
