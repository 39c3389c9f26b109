// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/mission_trial.h>

#include <string>
#include <vector>

namespace homeward
{

/** What a robot does when something goes wrong, as `--without` names it. */
std::vector<std::string> recoveryNames();

/** Switches recoveries off, to see what they are good for. @param names of recoveryNames() */
void switchOff(const std::vector<std::string> &names, MissionTrialOptions &options);

} // namespace homeward
