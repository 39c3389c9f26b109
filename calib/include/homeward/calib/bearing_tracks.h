// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/mount.h>
#include <homeward/camera/panorama.h>

#include <vector>

namespace homeward
{

/** What was seen during a drive, and where odometry says that was. */
struct DriveView
{
  Pose2 oMr;         ///< robot in the odometry frame when it was taken
  Panorama panorama; ///< gray
};

/**
 * Follows the corners of a scene from picture to picture of a drive, for calibrateMount(): nothing
 * needs to be put up. A corner that is lost, or that does not lead back to where it came from,
 * ends; new ones take its place.
 * @param drive in the order of the drive, of one geometry; the turn from picture to picture is
 * known by odometry, the way should be short, 0.15 m or so
 * @param visible CV_8UC1 of the pictures' size, 0 where they show no scene, or empty
 * @return one a view; landmarks have their number from their first sight on
 * @throw LogicError when geometries differ or a picture is not gray, ConfigError when a picture is
 * the same as the one before although the robot moved
 */
std::vector<MountSample> trackBearings(const std::vector<DriveView> &drive,
                                       const cv::Mat &visible = cv::Mat());

} // namespace homeward
