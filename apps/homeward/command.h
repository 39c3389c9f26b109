// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"

namespace homeward
{

/** Each adds its command. */
void addExploreCommand(CliCommand app);
void addNavigateCommand(CliCommand app);
void addReplayCommand(CliCommand app);
void addRigCommand(CliCommand app);
void addMapCommand(CliCommand app);
void addUnwrapCommand(CliCommand app);
void addScanCommand(CliCommand app);
void addHomeCommand(CliCommand app);
void addLocalizeCommand(CliCommand app);
void addEvaluateCommand(CliCommand app);

/** Each adds its command of `map`. */
void addMapNodeCommand(CliCommand map);
void addMapEditCommand(CliCommand map);
void addMapMergeCommand(CliCommand map);
void addMapServeCommand(CliCommand map);

/** Each adds its command of `evaluate`. */
void addEvaluateHomingCommand(CliCommand evaluate);
void addEvaluateArrivalCommand(CliCommand evaluate);
void addEvaluatePlacesCommand(CliCommand evaluate);
void addEvaluateRowsCommand(CliCommand evaluate);
void addEvaluateMissionCommand(CliCommand evaluate);
void addDataSetCommand(CliCommand evaluate);

} // namespace homeward
