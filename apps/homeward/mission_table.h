// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/mission_summary.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace homeward
{

/** Name and summary of each world. */
using WorldSummaries = std::vector<std::pair<std::string, MissionSummary>>;

/** A line a figure, a column a world; means and shares with their 95 % confidence interval. */
std::string missionTable(const WorldSummaries &worlds);

/** The same, by name of the world. */
nlohmann::json missionSummaryJson(const WorldSummaries &worlds);

/** Coverage over simulated time as SVG, a line a seed. */
std::string coverageChart(const std::string &world, const std::vector<MissionTrial> &trials);

} // namespace homeward
