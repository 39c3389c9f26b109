// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"

namespace homeward
{

/** Pictures of a target in, camera file and report out; what the program does by itself. */
void addCalibrateCommand(CliCommand app);

/** The same from pictures of a room. */
void addQuickCommand(CliCommand app);

/** Prints targets to scale. */
void addTargetCommand(CliCommand app);

/** Where the camera sits on the robot. */
void addMountCommand(CliCommand app);

/** One camera file from another: formats and models. */
void addConvertCommand(CliCommand app);

} // namespace homeward
