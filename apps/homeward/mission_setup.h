// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mission_robot.h"

#include <homeward/pilot/pilot.h>
#include <homeward/store/map_file.h>

#include <string>

namespace homeward
{

/** Settings of the pilot for a robot, with the homing method of the command line. */
PilotOptions pilotOptions(const MissionRobot &robot, const std::string &homingMethod);

/** What counts as an open direction when a drive is `forwardDistance` metres long. */
OpenDirectionOptions openDirectionOptions(double forwardDistance);

/** What a map made with this robot and these settings says about itself. */
MapHeader mapHeader(const RobotFiles &robot, const PilotOptions &options);

/** Makes every place of a map known to the pilot by sight. */
void rememberAll(const MapFile &file, Pilot &pilot);

/** "done", "stopped" or "failed". */
std::string name(Outcome outcome);

/** Rewrites one status line on standard error; does nothing when that is no terminal. */
void showProgress(const std::string &line);

/** Ends the status line. */
void endProgress();

} // namespace homeward
