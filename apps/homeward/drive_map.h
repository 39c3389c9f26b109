// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace homeward
{

/** A map to be made of a drive. */
struct DriveMapArguments
{
  std::string bag; ///< first of a recording, or of any other program
  std::string map;
  std::string rig; ///< empty: that of the recording, else the simulated robot's
  std::string imageTopic;
  std::string scanTopic;
  std::string odometryTopic;
  double forwardDistance = 2.0; ///< metres
  bool overwrite = false;
  std::string json;
};

/**
 * Makes a map of a drive that somebody steered, and says what came of it.
 * @return exit status
 * @throw ConfigError in a program without bags, StoreError when the bag cannot be read
 */
int makeDriveMap(const DriveMapArguments &arguments);

} // namespace homeward
