// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot_files.h"

#include "files.h"

namespace homeward
{
namespace fs = std::filesystem;

RobotFiles loadRobotFiles(const std::string &rigFile)
{
  const fs::path path = rigFile.empty() ? shippedFile("rigs/sim.yaml") : fs::path(rigFile);
  const Rig rig = parseRig(readText(path, "rig file"), path.string());
  const std::string robotFile = (path.parent_path() / rig.robot).lexically_normal().string();
  const RobotDescription robot =
      parseRobotDescription(readText(robotFile, "robot description"), robotFile);
  const std::string cameraFile = (path.parent_path() / rig.camera).lexically_normal().string();
  const std::string cameraText = readText(cameraFile, "camera file");
  return {path, rig, robotFile, robot, cameraText, parseMirrorCamera(cameraText, cameraFile)};
}

} // namespace homeward
