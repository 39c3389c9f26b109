// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/dataset/data_set.h>
#include <homeward/pilot/motion.h>

#include <atomic>
#include <functional>

namespace homeward
{

/** How a robot drives to find where its camera sits. */
struct MountDriveOptions
{
  int turns = 36;      ///< pictures of the turn on the spot
  double way = 1.5;    ///< metres straight ahead, as far as there is room
  double least = 0.6;  ///< metres it must be at least
  double step = 0.1;   ///< metres from one picture to the next
  double speed = 0.15; ///< m/s
};

/**
 * Turns once on the spot, then drives straight the way where most room is; stands for each picture.
 * The pictures bear the robot's odometry, which is what calibrateMount() wants.
 * @param stop ends the drive, the robot standing, with StopRequested
 * @param taken told the number of pictures so far
 * @throw RuntimeError where there is no room, DeviceError when a device is gone; the robot stands
 */
DataSet driveForMount(const Devices &devices, const RobotDescription &robot,
                      const MirrorCamera &camera, const MountDriveOptions &options,
                      const std::atomic<bool> &stop, const std::function<void(int)> &taken = {});

} // namespace homeward
