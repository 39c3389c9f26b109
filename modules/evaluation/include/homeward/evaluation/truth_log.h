// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>
#include <homeward/core/pose2.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/**
 * What only the simulator knows of an exploration: where the places of a map truly are. Kept in a
 * file of its own beside the map, for evaluation and for pictures; nothing that drives the robot
 * reads it.
 */
struct TruthLog
{
  std::string world;                 ///< SDF file, as given
  std::string robot;                 ///< URDF file, as given
  std::string light;                 ///< preset's name
  std::uint64_t seed = 0;            ///< of the simulation
  double forwardDistance = 0.0;      ///< metres
  Pose2 start;                       ///< of the robot in the world
  Pose2 end;                         ///< likewise
  std::map<NodeId, Pose2> nodes;     ///< the robot in the world when each node was made
  std::vector<Eigen::Vector2d> path; ///< driven, world, metres
};

/** The file that goes with a map: `<map>.truth.json`. */
std::filesystem::path truthLogFile(const std::filesystem::path &map);

/** @throw StoreError naming the file when it cannot be written; an older file then stays */
void saveTruthLog(const std::filesystem::path &file, const TruthLog &log);

/** Nothing when there is no such file. @throw StoreError naming the file when it is damaged */
std::optional<TruthLog> loadTruthLog(const std::filesystem::path &file);

} // namespace homeward
