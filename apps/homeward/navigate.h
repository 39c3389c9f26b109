// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mission_robot.h"
#include "mission_viewer.h"

#include <cstdint>
#include <string>

namespace homeward
{

/** What a navigation is told. */
struct NavigateArguments
{
  RobotArguments robot;
  std::string map;
  std::string to;
  int repeat = 1;
  std::int64_t from = -1;
  std::string homing = "minwarping";
  double maxTime = 3600.0;
  bool refresh = false;
  bool overwrite = false; ///< of a replay, which writes the map that it refreshes anew; no option
  bool verbose = false;
  ViewArguments view;
  std::string json;
};

/** Drives to places of a map and says what came of it. @return exit status */
int navigate(const NavigateArguments &arguments);

/** The arguments of a navigation that was recorded. @throw std::exception when it is none */
NavigateArguments navigateArguments(const nlohmann::json &mission);

} // namespace homeward
