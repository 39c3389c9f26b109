// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>

#include <Eigen/Core>

#include <vector>

namespace homeward
{

/** A landmark seen from one place. */
struct LandmarkBearing
{
  int landmark = 0;     ///< the same number wherever the same thing is seen
  double bearing = 0.0; ///< in frame p, counter-clockwise from its x, radians
};

/** What odometry and camera say at one time of a drive. */
struct MountSample
{
  Pose2 oMr;                             ///< robot in the odometry frame, metres and radians
  std::vector<LandmarkBearing> bearings; ///< of what was seen from there
};

/** Where the camera sits on the robot, in the plane. */
struct MountEstimate
{
  Pose2 rMp;                  ///< mirror's focus in the robot's frame, metres and radians
  Eigen::Matrix3d covariance; ///< of x, y (metres) and heading (radians) of rMp
  double rms = 0.0;           ///< of the bearings, radians
  int landmarks = 0;          ///< that bearings were taken of
};

/**
 * Yaw and offset of the camera from a short drive: a turn on the spot shows the offset, a straight
 * line the yaw. Landmarks may stand anywhere, nobody needs to know where; they are estimated along,
 * least squares on the bearings with Huber's weights. Odometry gives the scale; how far its turns
 * are wrong is estimated too, for wheels that skid through a whole turn miss it by several degrees.
 * Sigmas are at least what leaving out one eighth of the landmarks after the other shows.
 * @throw ConfigError with what to drive when less than a quarter turn or 0.5 m was driven, fewer
 * than 25 landmarks were seen from three places each, the average one from less than 15 % of the
 * places, they all stand on one side, the sigma of
 * yaw or offset is above 1.5 degrees or 3 cm, or pictures and odometry do not fit
 */
MountEstimate calibrateMount(const std::vector<MountSample> &drive);

} // namespace homeward
