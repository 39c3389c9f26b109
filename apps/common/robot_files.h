// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>
#include <homeward/robot/rig.h>
#include <homeward/robot/robot_description.h>

#include <string>

namespace homeward
{

/** A rig and what its files hold. */
struct RobotFiles
{
  std::filesystem::path rigFile;
  Rig rig;
  std::string robotFile; ///< URDF file
  RobotDescription robot;
  std::string cameraText; ///< the camera file, as it stands
  MirrorCamera camera;
};

/**
 * Reads a rig file and the files that it names.
 * @param rigFile empty for the simulated robot that ships
 * @throw ConfigError naming the file that is missing or wrong
 */
RobotFiles loadRobotFiles(const std::string &rigFile);

} // namespace homeward
