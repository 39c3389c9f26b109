// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/homing_servo.h>

#include <homeward/camera/visp_bridge.h>
#include <homeward/core/error.h>
#include <homeward/servo/feature_heading.h>
#include <homeward/servo/feature_home_vector.h>

#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/vs/vpServo.h>

#include <algorithm>
#include <cmath>
#include <string>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace homeward
{

namespace
{

void requireWithin(const char *what, double value, double above, double most)
{
  if (!(value > above) || !(value <= most)) {
    throw LogicError(std::string(what) + " is " + std::to_string(value) + ", must be above " +
                     std::to_string(above) + " and at most " + std::to_string(most));
  }
}

void checkOptions(const HomingServoOptions &options)
{
  constexpr double kAny = 1e6;
  requireWithin("gain", options.gain, 0.0, kAny);
  requireWithin("rangeShare", options.rangeShare, 0.0, 0.3);
  requireWithin("landmarkRange", options.landmarkRange, 0.0, kAny);
  requireWithin("rangeMin", options.rangeMin, 0.0, options.rangeMax);
  requireWithin("rangeMax", options.rangeMax, 0.0, kAny);
  requireWithin("turnFirst", options.turnFirst, 0.0, radians(80.0));
  requireWithin("speedMax", options.speedMax, 0.0, kAny);
  requireWithin("turnRateMax", options.turnRateMax, 0.0, kAny);
}

/** Twist of the robot's frame from (v, w). */
vpMatrix unicycleJacobian()
{
  vpMatrix eJe(6, 2);
  eJe[0][0] = 1.0;
  eJe[5][1] = 1.0;
  return eJe;
}

} // namespace

/** The two tasks, in the words of vpServo: e is the robot, c the mirror. */
struct HomingServo::Tasks
{
  Tasks(const Eigen::Isometry3d &rMp, double gain)
  {
    const vpVelocityTwistMatrix pVr(toVisp(rMp.inverse()));
    for (vpServo *task : {&approach, &align}) {
      task->setServo(vpServo::EYEINHAND_L_cVe_eJe);
      task->setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
      task->setLambda(gain);
      task->set_cVe(pVr);
      task->set_eJe(unicycleJacobian());
    }
    approach.addFeature(vector, wantedVector);
    align.addFeature(heading, wantedHeading);
  }

  FeatureHomeVector vector;
  FeatureHomeVector wantedVector;
  FeatureHeading heading;
  FeatureHeading wantedHeading;
  vpServo approach;
  vpServo align;
};

HomingServo::HomingServo(const Eigen::Isometry3d &rMp, const HomingServoOptions &options)
    : m_options(options), m_rMp{rMp.translation().x(), rMp.translation().y(),
                                std::atan2(rMp.linear()(1, 0), rMp.linear()(0, 0))}
{
  checkOptions(options);
  m_tasks = std::make_unique<Tasks>(rMp, options.gain);
}

HomingServo::~HomingServo() = default;
HomingServo::HomingServo(HomingServo &&) noexcept = default;
HomingServo &HomingServo::operator=(HomingServo &&) noexcept = default;

Twist2 HomingServo::limited(double v, double w) const
{
  const double excess =
      std::max({1.0, std::abs(v) / m_options.speedMax, std::abs(w) / m_options.turnRateMax});
  return {std::max(0.0, v / excess), w / excess};
}

HomeVector HomingServo::homeOfRobot(const HomeVector &seen, double metres) const
{
  const Eigen::Vector2d rTp = m_rMp.translation();
  const double bearing = seen.direction + m_rMp.heading;
  const double range = seen.distanceProxy * metres;
  const Eigen::Vector2d way = range * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)) + rTp -
                              Eigen::Rotation2Dd(-seen.headingChange) * rTp;
  HomeVector home = seen;
  home.direction = wrapAngle(std::atan2(way.y(), way.x()) - m_rMp.heading);
  home.distanceProxy = way.norm() / m_options.landmarkRange;
  return home;
}

Twist2 HomingServo::approach(const HomeVector &home)
{
  if (!std::isfinite(home.direction) || !std::isfinite(home.distanceProxy)) {
    throw LogicError("home vector has direction " + std::to_string(home.direction) +
                     " and distance proxy " + std::to_string(home.distanceProxy) +
                     ", must be finite");
  }
  const double bearing = wrapAngle(home.direction + m_rMp.heading); // in the robot's frame
  if (std::abs(bearing) > m_options.turnFirst) {
    return limited(0.0, m_options.gain * bearing);
  }
  // A mirror behind the axle makes the task singular at a range of its distance from it.
  const double least = std::max(m_options.rangeMin, -3.0 * m_rMp.x);
  const double range =
      std::max(least, std::min(m_options.rangeMax, home.distanceProxy * m_options.landmarkRange));
  // The wanted bearing is the robot's forward axis, seen in p.
  m_tasks->vector.set(range, home.direction);
  m_tasks->wantedVector.set((1.0 - m_options.rangeShare) * range, -m_rMp.heading);
  const vpColVector command = m_tasks->approach.computeControlLaw();
  return limited(command[0], command[1]);
}

Twist2 HomingServo::align(double headingError)
{
  m_tasks->heading.set(headingError);
  const vpColVector command = m_tasks->align.computeControlLaw();
  return limited(0.0, command[1]);
}

} // namespace homeward
