// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/homing/home_vector.h>

#include <Eigen/Geometry>

#include <memory>

namespace homeward
{

/** What HomingServo may be told. */
struct HomingServoOptions
{
  double gain = 1.5;          ///< 1/s, of the bearing and of the heading
  double rangeShare = 0.25;   ///< share of the range taken as its error, (0, 0.3]; see approach()
  double landmarkRange = 2.0; ///< metres that a distance proxy of 1 stands for
  double rangeMin = 0.1;      ///< metres, the proxy is bounded to this
  double rangeMax = 1.0;      ///< metres, and to this
  double turnFirst = radians(60.0); ///< a bearing beyond this turns on the spot, (0, 80 degrees]
  double speedMax = 0.4;            ///< m/s
  double turnRateMax = 0.8;         ///< rad/s
};

/** Drives a robot that cannot slide sideways home, by visual servoing on home vectors. */
class HomingServo
{
public:
  /**
   * @param rMp pose of the mirror's focus on the robot, upright
   * @throw LogicError for options out of range
   */
  explicit HomingServo(const Eigen::Isometry3d &rMp, const HomingServoOptions &options = {});
  ~HomingServo();
  HomingServo(HomingServo &&) noexcept;
  HomingServo &operator=(HomingServo &&) noexcept;

  /**
   * Where the robot must go, rather than its mirror: a mirror ahead of the axle stands elsewhere
   * when the robot stands at home turned otherwise.
   * @param seen home of the mirror's focus, in frame p of the current view
   * @param metres that its distance proxy of 1 stands for
   * @return home of the focus once the robot has come straight there and not turned yet, in frame p
   */
  HomeVector homeOfRobot(const HomeVector &seen, double metres) const;

  /**
   * Velocity of the robot towards home: s = (rho, beta), s* = ((1 - rangeShare) rho, 0),
   * (v, w) = -gain (L pVr rJr)^+ (s - s*).
   *
   * The range is a bounded proxy. Where it is c times too long, d beta / dt = -gain (beta -
   * rangeShare (c - 1) tan(beta)): with a share of 0.25 the bearing shrinks up to c = 3 wherever
   * |beta| <= 60 degrees. Farther aside, where the task nears its singularity cos(beta) = 0, the
   * robot turns on the spot. v >= 0; limits shrink v and w alike, which keeps the path.
   * @param home in frame p of the current view
   * @throw LogicError unless direction and distanceProxy are finite
   */
  Twist2 approach(const HomeVector &home);

  /**
   * Velocity that turns the robot to the home heading; v = 0.
   * @param headingError heading of the robot minus the wanted one, rad
   * @throw LogicError unless finite
   */
  Twist2 align(double headingError);

  /** Pose of frame p on the robot, seen from above. */
  const Pose2 &mirror() const { return m_rMp; }

  /** As it was made. */
  const HomingServoOptions &options() const { return m_options; }

private:
  struct Tasks;

  Twist2 limited(double v, double w) const;

  HomingServoOptions m_options;
  Pose2 m_rMp;
  std::unique_ptr<Tasks> m_tasks;
};

} // namespace homeward
