// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/mission_trial.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** A world that is tried. */
struct StudiedWorld
{
  std::string name; ///< of its file, without folder and ending
  std::string file;
  std::string content; ///< hash of the file's text
  std::shared_ptr<const Scene> scene;
};

/**
 * Reads worlds; what is broken in them is said on standard error.
 * @throw ConfigError when one is missing or no world, or two have one name
 */
std::vector<StudiedWorld> loadWorlds(const std::vector<std::string> &files);

/**
 * Results of trials in a folder: `<world>-<seed>.json` is there, whole, when a trial has come to
 * its end, beside its map `<world>-<seed>.hwm`. So a study that was broken off knows what is left.
 */
class MissionStudy
{
public:
  /**
   * Makes the folder if need be.
   * @param options what all trials have in common and what results made otherwise differ in
   * @throw ConfigError when it cannot be written to
   */
  MissionStudy(std::filesystem::path folder, nlohmann::json options);

  /**
   * What is to be tried, kept in the folder.
   * @param maps folder of an earlier study whose map is driven through; empty: explore
   * @throw ConfigError when it has no result of that world and seed, or a damaged one
   */
  MissionTask task(const StudiedWorld &world, std::uint64_t seed,
                   const std::filesystem::path &maps = {}) const;

  /**
   * The result of a trial, if it has come to its end.
   * @throw ConfigError when it is damaged, or was made with other options
   */
  std::optional<MissionTrial> find(const StudiedWorld &world, std::uint64_t seed) const;

  /** @throw RuntimeError when it cannot be written; nothing is left behind then */
  void keep(const StudiedWorld &world, const MissionTrial &trial) const;

  /** A file of the folder. */
  std::string file(const std::string &name) const { return (m_folder / name).string(); }

private:
  static std::string resultName(const StudiedWorld &world, std::uint64_t seed);
  std::string resultFile(const StudiedWorld &world, std::uint64_t seed) const;
  nlohmann::json optionsIn(const StudiedWorld &world) const;

  std::filesystem::path m_folder;
  nlohmann::json m_options;
};

} // namespace homeward
