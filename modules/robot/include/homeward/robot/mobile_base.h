// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/time.h>

#include <string>
#include <vector>

namespace homeward
{

/** One echo of one sonar. */
struct SonarEcho
{
  double bearing = 0.0; ///< axis of the cone in the robot's frame, radians
  double x = 0.0;       ///< the transducer in the robot's frame, metres
  double y = 0.0;       ///< the transducer in the robot's frame, metres
  double range = 0.0;   ///< metres; NaN where nothing echoed
};

/** What a base says of itself. */
struct BaseState
{
  Time stamp{};                 ///< when it was so
  Pose2 odometry;               ///< of the robot in the odometry frame; drifts
  Twist2 velocity;              ///< measured
  bool stalled = false;         ///< wheels commanded but held
  std::vector<SonarEcho> sonar; ///< newest echo of every transducer; empty without sonar
  bool bumpedAhead = false;     ///< a bumper at its front is pressed
  bool bumpedBehind = false;    ///< a bumper at its rear is pressed
  std::string halt;             ///< why it stands whatever it is told: "its emergency stop is
                                ///< pressed"; empty while it drives
};

/** Something that drives. */
class MobileBase
{
public:
  virtual ~MobileBase() = default;

  /**
   * Sets the velocity to reach, m/s forward and rad/s counter-clockwise. It holds until the next
   * call or until the base's watchdog stops it.
   * @throw DeviceError when the base is gone
   */
  virtual void drive(const Twist2 &twist) = 0;

  /** The newest state. @throw DeviceError when the base is gone */
  virtual BaseState state() = 0;
};

} // namespace homeward
