// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mission_robot.h"
#include "mission_setup.h"
#include "mission_viewer.h"

#include <string>

namespace homeward
{

/** What an exploration is told. */
struct ExploreArguments
{
  RobotArguments robot;
  std::string map;
  ExploreSettings settings;
  bool overwrite = false;
  bool resume = false;
  bool verbose = false;
  ViewArguments view;
  std::string json;
};

/** Explores and says what came of it. @return exit status */
int explore(const ExploreArguments &arguments);

} // namespace homeward
