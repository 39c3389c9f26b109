// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mission_robot.h"

#include <homeward/store/map_file.h>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <memory>
#include <string>

namespace homeward
{

/** `--record` and `--record-split`. */
void addRecordOptions(CliCommand command, RecordArguments &arguments);

/** Where a recording keeps the map that its mission began with: beside the bag. */
std::filesystem::path mapBefore(const std::string &bag);

/** Keeps the map that a mission begins with for its replay. @throw StoreError */
void keepMapBefore(const MapFile &map, const std::string &bag);

/**
 * The same robot, with all that passes between it and its mission written into bags.
 * @param mission its command and settings, for the replay
 * @throw ConfigError in a program without bags, StoreError when they cannot be written
 */
std::unique_ptr<MissionRobot> recordedRobot(std::unique_ptr<MissionRobot> robot,
                                            const RecordArguments &arguments,
                                            const nlohmann::json &mission);

/** The mission of a recording, as recordedRobot() was given it. Throws as replayedRobot(). */
nlohmann::json recordedMission(const std::string &bag);

/**
 * The robot of a recording, as it was then.
 * @throw ConfigError in a program without bags, StoreError when the bag is no recording
 */
std::unique_ptr<MissionRobot> replayedRobot(const std::string &bag);

/** The files of a recording's robot; nothing for a bag of another program. */
std::optional<RobotFiles> recordedFiles(const std::string &bag);

/** What a program without bags says to whoever wants them. @throw ConfigError */
[[noreturn]] void refuseBags();

/** Gives a bag that was never closed its index. @return what was done, for people */
std::string repairRecording(const std::string &bag);

} // namespace homeward
