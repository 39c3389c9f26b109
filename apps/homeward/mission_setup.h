// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"
#include "robot_files.h"

#include <homeward/mission/explorer.h>
#include <homeward/pilot/pilot.h>
#include <homeward/store/map_file.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace homeward
{

/** What counts as an open direction when a drive is `forwardDistance` metres long. */
OpenDirectionOptions openDirectionOptions(double forwardDistance);

/**
 * Settings of the pilot for a robot, with the homing method of the command line.
 * @param runsByItself whether time goes on while nobody asks for it, as with real devices
 */
PilotOptions pilotOptions(const Rig &rig, bool runsByItself, const std::string &homingMethod);

/** What the command line says of an exploration. */
struct ExploreSettings
{
  double forwardDistance = 2.0; ///< metres
  std::string homing = "minwarping";
  double histogramThreshold = 0.0; ///< 0: places are verified
  double maxTime = 1e5;            ///< s of robot time
  bool closeKnown = false;         ///< directions to where a node is are not driven
  bool equalCosts = false;         ///< ways are planned by the number of edges
};

/** `--forward-distance`, `--homing`, `--histogram-threshold`, `--close-known`, `--equal-costs`,
 * `--max-time`. */
void addExploreSettings(CliCommand command, ExploreSettings &settings);

/** For a recording. */
nlohmann::json settingsJson(const ExploreSettings &settings);

/** Inverse of settingsJson(). @throw std::exception when they are none */
ExploreSettings exploreSettings(const nlohmann::json &json);

/** As pilotOptions(), for an exploration. */
PilotOptions explorationOptions(const Rig &rig, bool runsByItself, const ExploreSettings &settings);

/** Settings of the exploration itself. */
ExplorerOptions explorerOptions(const ExploreSettings &settings);

/** What a map made with this robot and these settings says about itself. */
MapHeader mapHeader(const RobotFiles &robot, const PilotOptions &options);

/** Rewrites one status line on standard error; does nothing when that is no terminal. */
void showProgress(const std::string &line);

/** Ends the status line. */
void endProgress();

} // namespace homeward
