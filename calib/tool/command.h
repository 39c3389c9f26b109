// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli_app.h"

namespace homeward
{

/** Exit statuses of every command. */
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

/** Pictures of a target in, camera file and report out; what the program does by itself. */
void addCalibrateCommand(CLI::App &app, int &status);

/** The same from pictures of a room. */
void addQuickCommand(CLI::App &app, int &status);

/** Prints targets to scale. */
void addTargetCommand(CLI::App &app, int &status);

/** Where the camera sits on the robot. */
void addMountCommand(CLI::App &app, int &status);

/** One camera file from another: formats and models. */
void addConvertCommand(CLI::App &app, int &status);

} // namespace homeward
