// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot_files.h"

#include "files.h"

namespace homeward
{
namespace fs = std::filesystem;

namespace
{

/** A file that a rig names. */
std::string beside(const fs::path &rigFile, const std::string &name)
{
  return (rigFile.parent_path() / name).lexically_normal().string();
}

} // namespace

RobotFiles loadRobotFiles(const std::string &rigFile)
{
  const fs::path path = rigFile.empty() ? shippedFile("rigs/sim.yaml") : fs::path(rigFile);
  const std::string rigText = readText(path, "rig file");
  const Rig rig = parseRig(rigText, path.string());
  return parseRobotFiles(path, rigText, readText(beside(path, rig.robot), "robot description"),
                         readText(beside(path, rig.camera), "camera file"));
}

RobotFiles parseRobotFiles(const fs::path &rigFile, const std::string &rigText,
                           const std::string &robotText, const std::string &cameraText)
{
  const Rig rig = parseRig(rigText, rigFile.string());
  const std::string robotFile = beside(rigFile, rig.robot);
  return {rigFile,    rigText,
          rig,        robotFile,
          robotText,  parseRobotDescription(robotText, robotFile),
          cameraText, parseMirrorCamera(cameraText, beside(rigFile, rig.camera))};
}

} // namespace homeward
