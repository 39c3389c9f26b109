// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/robot/clock.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/visp_base/visp_types.h>

#include <functional>
#include <optional>

namespace homeward
{

/** What robots of ViSP do not agree about. */
struct VispBaseOptions
{
  /** In which the robot takes (v, w): vpRobotPioneer this one, vpSimulatorPioneer
   * ARTICULAR_FRAME. */
  vpRobot::vpControlFrameType frame = vpRobot::REFERENCE_FRAME;
  /** The robot in the frame whose position it tells: vpSimulatorPioneer::get_cMe(), its camera. */
  vpHomogeneousMatrix cMe = {};
  /** The measured (v, w) of a robot that tells it: `pioneer.getVelocity(vpRobot::REFERENCE_FRAME)`.
   * vpRobot has no name for that. */
  std::function<vpColVector()> velocity = {};
};

/**
 * Any mobile robot of ViSP that takes (v, w) as a MobileBase.
 *
 * Odometry is vpRobot::getPosition(REFERENCE_FRAME), six numbers as BaseRobot gives them. The
 * velocity is what VispBaseOptions::velocity says, else how odometry has changed since the last
 * state(). Of a robot that tells no position, as vpRobotPioneer, odometry is its velocity carried
 * on from call to call: as measured, else as commanded. Stalls, sonar and bumpers are not in
 * vpRobot. There is no watchdog but the robot's own, and its maximum velocities hold
 * (vpRobot::setMaxTranslationVelocity(), 0.2 m/s at first).
 */
class VispBase : public MobileBase
{
public:
  /** Puts the robot into velocity control. @param robot, clock must outlive this */
  VispBase(vpRobot &robot, const Clock &clock, const VispBaseOptions &options = {});

  void drive(const Twist2 &twist) override;
  BaseState state() override;

private:
  std::optional<Pose2> toldPose();
  std::optional<Twist2> toldVelocity();
  void reckon(); ///< carries the velocity on until now

  vpRobot &m_robot;
  const Clock &m_clock;
  VispBaseOptions m_options;
  Twist2 m_driven;  ///< as measured or commanded last
  Pose2 m_reckoned; ///< since the beginning
  Time m_reckonedAt;
  BaseState m_state; ///< newest
};

} // namespace homeward
