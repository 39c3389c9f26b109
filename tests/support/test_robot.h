// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>
#include <homeward/core/angle.h>
#include <homeward/robot/robot_description.h>

namespace homeward
{

/**
 * A robot of the size of a Pioneer 3-AT: the body from 6 to 28 cm, a laser box on it up to 42 cm
 * ahead, a mast of 10 x 10 cm up to 95 cm in the middle.
 */
inline RobotDescription testRobot()
{
  RobotDescription robot;
  robot.name = "test_robot";
  robot.body = {{"base_link", -0.25, 0.25, -0.245, 0.245, 0.06, 0.28},
                {"laser_body", 0.08, 0.24, -0.08, 0.08, 0.28, 0.42},
                {"mast", -0.05, 0.05, -0.05, 0.05, 0.28, 0.95}};
  robot.rMl.translation() = Eigen::Vector3d(0.16, 0.0, 0.33);
  robot.rMp.translation() = Eigen::Vector3d(0.0, 0.0, 0.9);
  for (int i = 0; i < 8; ++i) {
    const double bearing = radians(70.0 - 20.0 * i);
    robot.sonars.push_back({0.2 * std::cos(bearing), 0.13 * std::sin(bearing), 0.25, bearing});
  }
  robot.wheelRadius = 0.11;
  robot.track = 0.4;
  return robot;
}

/** The nominal simulated camera, as data/cameras/sim_nominal.yaml has it. */
inline MirrorCamera testCamera()
{
  UnifiedCamera::Parameters parameters;
  parameters.xi = 0.95;
  parameters.fx = 108.0;
  parameters.fy = 108.0;
  parameters.cx = 319.5;
  parameters.cy = 239.5;
  return {UnifiedCamera(parameters, 640, 480), {30.0, 236.0}, {radians(-90.0), true}};
}

} // namespace homeward
