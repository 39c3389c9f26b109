// SPDX-License-Identifier: GPL-3.0-or-later
#include "dashboard.h"

#include "dashboard_json.h"
#include "page_files.h"
#include "stop_signal.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace homeward
{
namespace
{

using nlohmann::json;

constexpr std::size_t kLogLines = 400;
constexpr std::size_t kMostWaiting = 32;
constexpr std::chrono::milliseconds kAnswerWithin{1500};
constexpr std::chrono::milliseconds kLook{100};

std::vector<PageFile> filesOfPage()
{
  if (pageFiles().empty()) {
    throw ConfigError("--serve: this program was built without its page (esbuild was missing); "
                      "--view shows a mission too");
  }
  return pageFiles();
}

NodeId nodeIn(const json &arguments, const char *key, const MapFile &file)
{
  const auto found = arguments.find(key);
  if (found == arguments.end() || !found->is_number_integer() ||
      !file.map().contains(NodeId{found->get<std::int64_t>()})) {
    throw ConfigError("there is no such node");
  }
  return NodeId{found->get<std::int64_t>()};
}

std::string nameIn(const json &arguments)
{
  const auto found = arguments.find("name");
  if (found == arguments.end() || !found->is_string() || found->get<std::string>().size() > 60) {
    throw ConfigError("a name of at most 60 letters is needed");
  }
  return found->get<std::string>();
}

PageAnswer edited(MapFile &file, const std::string &words, const MapChange &change)
{
  file.edit(words, {.changes = {change}});
  return {200, words};
}

PageAnswer rename(const json &arguments, MapFile &file)
{
  const NodeId node = nodeIn(arguments, "node", file);
  const std::string name = nameIn(arguments);
  return edited(
      file, "node " + std::to_string(node.value) + (name.empty() ? " has no name" : " is ") + name,
      NodeNamed{node, name});
}

PageAnswer forbid(const json &arguments, MapFile &file)
{
  const NodeId a = nodeIn(arguments, "a", file);
  const NodeId b = nodeIn(arguments, "b", file);
  const std::optional<Edge> edge = file.map().edgeBetween(a, b);
  if (!edge) {
    throw ConfigError("there is no such way");
  }
  return edited(file,
                "the edge " + std::to_string(a.value) + " - " + std::to_string(b.value) +
                    (edge->forbidden ? " may be driven" : " is no-go"),
                EdgeForbidden{edge->id, !edge->forbidden});
}

PageAnswer closeDirection(const json &arguments, MapFile &file)
{
  const NodeId node = nodeIn(arguments, "node", file);
  const auto index = arguments.find("direction");
  const std::vector<Direction> &directions = file.map().node(node).directions;
  if (index == arguments.end() || !index->is_number_unsigned() ||
      index->get<std::size_t>() >= directions.size() ||
      directions[index->get<std::size_t>()].state != DirectionState::Open) {
    throw ConfigError("there is no such open direction");
  }
  const Direction &direction = directions[index->get<std::size_t>()];
  return edited(file, "a direction of node " + std::to_string(node.value) + " is closed",
                DirectionSettled{node, direction.id, DirectionState::Closed, "closed by hand"});
}

} // namespace

Dashboard::Dashboard(const std::string &address, bool drives)
    : m_drives(drives),
      m_server({.address = parseServeAddress(address),
                .token = newToken(),
                .files = filesOfPage(),
                .withoutToken = {"pause", "emergency-stop"},
                .find = [this](const std::string &path) { return find(path); },
                .command = [this](const PageCommand &command) { return obey(command); }})
{
  stopSignal(); // from now on Ctrl-C ends what waits
  publishRobot();
}

void Dashboard::show(const MissionScene &scene)
{
  for (const auto &[event, text] : sceneJson(scene)) {
    m_server.publish(event, text);
  }
}

void Dashboard::follow(MapFile &file, const std::vector<std::string> &log)
{
  {
    const std::lock_guard lock(m_mutex);
    m_log.insert(m_log.end(), log.begin(), log.end());
    while (m_log.size() > kLogLines) {
      m_log.pop_front();
    }
    m_server.publish("log", json(m_log).dump(-1, ' ', false, json::error_handler_t::replace));
  }
  workOff(file, nullptr);
  publishMap(file);
}

NextDrive Dashboard::await(MapFile &file, const std::string &words, bool resumable)
{
  {
    const std::lock_guard lock(m_mutex);
    m_words = words;
    m_resumable = resumable;
    m_stands = true;
  }
  publishMap(file);
  publishRobot();
  NextDrive next;
  while (next.kind == NextDrive::Kind::End && !stopSignal()) {
    {
      std::unique_lock lock(m_mutex);
      m_changed.wait_for(lock, kLook, [this] { return !m_waiting.empty(); });
    }
    workOff(file, &next);
  }
  {
    const std::lock_guard lock(m_mutex);
    m_stands = false;
    m_halt = stopSignal().load();
  }
  publishRobot();
  return next;
}

PageAnswer Dashboard::obey(const PageCommand &command)
{
  const bool emergency = command.name == "emergency-stop";
  if (emergency || command.name == "pause") {
    if (!m_drives) {
      return {409, "there is no robot here"};
    }
    m_halt = true;
    {
      const std::lock_guard lock(m_mutex);
      m_emergency = m_emergency || emergency;
    }
    if (emergency && onEmergency) {
      onEmergency();
    }
    publishRobot();
    return {200, emergency ? "emergency stop: it stands until that is released" : "it stands"};
  }
  if (command.name == "release") {
    {
      const std::lock_guard lock(m_mutex);
      m_emergency = false;
    }
    publishRobot();
    return {200, "the emergency stop is released; it still stands"};
  }
  if (command.name == "take") {
    return {200, "you command now"};
  }
  return obeyLater(command);
}

PageAnswer Dashboard::obeyLater(const PageCommand &command)
{
  std::future<PageAnswer> answer;
  {
    const std::lock_guard lock(m_mutex);
    if (m_waiting.size() >= kMostWaiting) {
      return {429, "too many commands wait"};
    }
    m_waiting.push_back({command, {}});
    answer = m_waiting.back().answer.get_future();
  }
  m_changed.notify_all();
  if (answer.wait_for(kAnswerWithin) == std::future_status::ready) {
    return answer.get();
  }
  return {202, "it is done when the robot's next step ends"};
}

std::optional<PageFile> Dashboard::find(const std::string &path) const
{
  const std::string kPrefix = "/view/";
  if (path.rfind(kPrefix, 0) != 0 || path.size() > kPrefix.size() + 12) {
    return std::nullopt;
  }
  const std::lock_guard lock(m_mutex);
  for (const auto &[node, bytes] : m_views) {
    if (path == kPrefix + std::to_string(node)) {
      return PageFile{path, "image/jpeg", bytes};
    }
  }
  return std::nullopt;
}

void Dashboard::publishRobot()
{
  const std::lock_guard lock(m_mutex);
  m_server.publish("robot", json{{"drives", m_drives},
                                 {"stands", m_stands},
                                 {"halting", m_halt && !m_stands},
                                 {"resumable", m_resumable},
                                 {"emergency", m_emergency},
                                 {"words", m_words}}
                                .dump(-1, ' ', false, json::error_handler_t::replace));
}

void Dashboard::publishMap(const MapFile &file)
{
  {
    const std::lock_guard lock(m_mutex);
    for (const auto &[id, node] : file.map().nodes()) {
      if (m_views.count(id.value) == 0 && file.hasView(id)) {
        const ViewBytes bytes = file.view(id);
        m_views[id.value] = std::string(bytes.begin(), bytes.end());
      }
    }
  }
  m_server.publish("map", mapJson(file));
}

void Dashboard::workOff(MapFile &file, NextDrive *next)
{
  bool changed = false;
  while (next == nullptr || next->kind == NextDrive::Kind::End) {
    std::optional<Waiting> waiting;
    {
      const std::lock_guard lock(m_mutex);
      if (m_waiting.empty()) {
        break;
      }
      waiting = std::move(m_waiting.front());
      m_waiting.pop_front();
    }
    PageAnswer answer;
    try {
      answer = carryOut(waiting->command, file, next);
      changed = true;
    }
    catch (const std::exception &error) { // what a page asks must not end a mission
      answer = {400, error.what()};
    }
    m_server.publish(
        "answer",
        json{{"command", waiting->command.name}, {"status", answer.status}, {"words", answer.words}}
            .dump(-1, ' ', false, json::error_handler_t::replace));
    waiting->answer.set_value(answer);
  }
  if (changed) {
    publishMap(file);
  }
}

PageAnswer Dashboard::carryOut(const PageCommand &command, MapFile &file, NextDrive *next)
{
  const json arguments = json::parse(command.arguments);
  if (command.name == "rename") {
    return rename(arguments, file);
  }
  if (command.name == "no-go") {
    return forbid(arguments, file);
  }
  if (command.name == "close") {
    return closeDirection(arguments, file);
  }
  if (command.name == "undo") {
    return {200, "undone: " + file.undo().description};
  }
  if (command.name != "go" && command.name != "resume") {
    return {400, "there is no such command"};
  }
  const std::lock_guard lock(m_mutex);
  if (!m_drives) {
    return {409, "there is no robot here"};
  }
  if (m_emergency) {
    return {409, "release the emergency stop first"};
  }
  if (next == nullptr) {
    return {409, "it drives; pause it first"};
  }
  if (command.name == "resume") {
    if (!m_resumable) {
      return {409, "it has nothing to go on with"};
    }
    *next = {NextDrive::Kind::Resume, {}};
    return {200, "it goes on"};
  }
  const NodeId goal = nodeIn(arguments, "node", file);
  *next = {NextDrive::Kind::GoTo, goal};
  return {200, "it drives to node " + std::to_string(goal.value)};
}

} // namespace homeward
