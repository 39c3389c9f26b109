// SPDX-License-Identifier: GPL-3.0-or-later
#include "mission_study.h"

#include "files.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/mission_trial_json.h>
#include <homeward/store/content_hash.h>

#include <cstdio>
#include <set>
#include <unistd.h>

namespace homeward
{
namespace fs = std::filesystem;

namespace
{

/** "light: night, now day". */
std::string firstDifference(const nlohmann::json &then, const nlohmann::json &now)
{
  for (const auto &[key, value] : now.items()) {
    if (!then.contains(key) || then[key] != value) {
      return key + ": " + (then.contains(key) ? then[key].dump() : "nothing") + ", now " +
             value.dump();
    }
  }
  return "more of them";
}

/** @throw ConfigError naming the file */
MissionTrial parseResult(const std::string &file, const std::string &text)
{
  try {
    return parseMissionTrial(text);
  }
  catch (const ConfigError &error) {
    throw ConfigError(file + " is " + error.what() + "; delete it or use another folder");
  }
}

/** What a result, known to be one, was made with. */
nlohmann::json optionsOf(const std::string &text)
{
  return nlohmann::json::parse(text).value("options", nlohmann::json::object());
}

} // namespace

std::vector<StudiedWorld> loadWorlds(const std::vector<std::string> &files)
{
  std::vector<StudiedWorld> worlds;
  std::set<std::string> names;
  for (const std::string &file : files) {
    const std::string name = fs::path(file).stem().string();
    if (!names.insert(name).second) {
      throw ConfigError("two worlds are called '" + name +
                        "', and so would be their results; rename one or use two folders");
    }
    worlds.push_back({name, file, contentHashText(readText(file, "world")), nullptr});
  }
  for (StudiedWorld &world : worlds) {
    world.scene = std::make_shared<const Scene>(loadScene(world.file));
    for (const std::string &problem : world.scene->problems) {
      std::fprintf(stderr, "homeward: %s: %s\n", fs::path(world.file).filename().c_str(),
                   problem.c_str());
    }
  }
  return worlds;
}

MissionStudy::MissionStudy(fs::path folder, nlohmann::json options)
    : m_folder(std::move(folder)), m_options(std::move(options))
{
  std::error_code error;
  fs::create_directories(m_folder, error);
  if (error || !fs::is_directory(m_folder, error) || ::access(m_folder.c_str(), W_OK | X_OK) != 0) {
    throw ConfigError("cannot write to the folder " + m_folder.string() +
                      "; check its name and its permissions");
  }
}

MissionTask MissionStudy::task(const StudiedWorld &world, std::uint64_t seed,
                               const fs::path &maps) const
{
  const std::string map = resultName(world, seed) + ".hwm";
  MissionTask task{world.name, world.file, world.scene, seed, m_folder / map};
  if (maps.empty()) {
    return task;
  }
  const std::string file = (maps / (resultName(world, seed) + ".json")).string();
  if (!fs::exists(file)) {
    throw ConfigError("there is no " + file + "; evaluate without --maps into that folder first");
  }
  const std::string text = readText(file, "result");
  task.explored = std::make_shared<const MissionTrial>(parseResult(file, text));
  const nlohmann::json then = optionsOf(text);
  if (then.value("world", "") != world.content || then.value("rig", "") != m_options["rig"]) {
    throw ConfigError(file + " was made with another world or rig; its map is not of this one");
  }
  task.map = maps / map;
  return task;
}

std::optional<MissionTrial> MissionStudy::find(const StudiedWorld &world, std::uint64_t seed) const
{
  const std::string file = resultFile(world, seed);
  if (!fs::exists(file)) {
    return std::nullopt;
  }
  const std::string text = readText(file, "result");
  const MissionTrial trial = parseResult(file, text);
  const nlohmann::json then = optionsOf(text);
  const nlohmann::json now = optionsIn(world);
  if (then != now) {
    throw ConfigError(file + " was made with other options (" + firstDifference(then, now) +
                      "); delete it or use another --out");
  }
  return trial;
}

void MissionStudy::keep(const StudiedWorld &world, const MissionTrial &trial) const
{
  nlohmann::json json = jsonHeader("evaluate mission");
  json.update(nlohmann::json::parse(missionTrialJson(trial)));
  json["options"] = optionsIn(world);
  writeText(resultFile(world, trial.seed), json.dump(1) + "\n");
}

std::string MissionStudy::resultName(const StudiedWorld &world, std::uint64_t seed)
{
  return world.name + "-" + std::to_string(seed);
}

std::string MissionStudy::resultFile(const StudiedWorld &world, std::uint64_t seed) const
{
  return file(resultName(world, seed) + ".json");
}

nlohmann::json MissionStudy::optionsIn(const StudiedWorld &world) const
{
  nlohmann::json options = m_options;
  options["world"] = world.content;
  return options;
}

} // namespace homeward
