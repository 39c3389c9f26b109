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
  std::string rigText; ///< this file, as it stands
  Rig rig;
  std::string robotFile; ///< URDF file
  std::string robotText; ///< likewise
  RobotDescription robot;
  std::string cameraText; ///< of the camera file
  MirrorCamera camera;
};

/**
 * Reads a rig file and the files that it names.
 * @param rigFile empty for the simulated robot that ships
 * @throw ConfigError naming the file that is missing or wrong
 */
RobotFiles loadRobotFiles(const std::string &rigFile);

/**
 * The same of files that were read before.
 * @param rigFile where the rig file stood
 * @throw ConfigError naming the file that is wrong
 */
RobotFiles parseRobotFiles(const std::filesystem::path &rigFile, const std::string &rigText,
                           const std::string &robotText, const std::string &cameraText);

} // namespace homeward
