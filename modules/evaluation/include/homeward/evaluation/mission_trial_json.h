// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/mission_trial.h>

#include <string>

namespace homeward
{

/**
 * A trial as a JSON object. What parseMissionTrial() makes of it is the same to the last digit.
 * Lengths end in `_m`, times in `_s` (simulated, `wall_` ones apart), angles in `_rad`; times by
 * the wall clock are the keys `wall_time_s` and `explore_wall_time_s`.
 */
std::string missionTrialJson(const MissionTrial &trial);

/** @throw ConfigError, without the file's name, when it is not what missionTrialJson() writes */
MissionTrial parseMissionTrial(const std::string &text);

} // namespace homeward
