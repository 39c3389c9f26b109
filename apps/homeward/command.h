// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli_app.h"

namespace homeward
{

/** Exit statuses of every command. */
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

/** Each adds its subcommand; a subcommand stores its exit status in `status` when it has run. */
void addExploreCommand(CLI::App &app, int &status);
void addNavigateCommand(CLI::App &app, int &status);
void addRigCommand(CLI::App &app, int &status);
void addMapCommand(CLI::App &app, int &status);
void addUnwrapCommand(CLI::App &app, int &status);
void addScanCommand(CLI::App &app, int &status);
void addHomeCommand(CLI::App &app, int &status);
void addLocalizeCommand(CLI::App &app, int &status);
void addEvaluateCommand(CLI::App &app, int &status);

/** Each adds its subcommand of `evaluate`. */
void addEvaluateHomingCommand(CLI::App &evaluate, int &status);
void addEvaluateArrivalCommand(CLI::App &evaluate, int &status);
void addEvaluatePlacesCommand(CLI::App &evaluate, int &status);
void addDataSetCommand(CLI::App &evaluate, int &status);

} // namespace homeward
