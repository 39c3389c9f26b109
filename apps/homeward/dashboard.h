// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/command.h>
#include <homeward/serve/page_server.h>
#include <homeward/store/map_file.h>
#include <homeward/viewer/mission_picture.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** What the robot is to do after it stood, as somebody at the page wants it. */
struct NextDrive
{
  /** Kinds of it. */
  enum class Kind
  {
    End,    ///< nothing: the program ends
    Resume, ///< what it was at
    GoTo    ///< the goal
  };
  Kind kind = Kind::End;
  NodeId goal = {};
};

/**
 * A mission or a map in the browser. What it shows is taken over from any thread and nobody waits
 * for a browser. Commands that change the map are carried out by the thread that the map belongs
 * to: between steps, or while the robot stands. A pause and an emergency stop are seen at
 * the next tick of whoever drives by halt().
 */
class Dashboard
{
public:
  /**
   * Opens the page.
   * @param address see parseServeAddress()
   * @param drives whether there is a robot to command
   * @throw ConfigError when the address cannot be had, or the program was built without the page
   */
  Dashboard(const std::string &address, bool drives);

  std::string url() const { return m_server.url(); }

  /** Whether the robot is to stand: for the pilot to look at. */
  const std::atomic<bool> &halt() const { return m_halt; }

  /** The robot is to stand until somebody resumes: from any thread. */
  void pause() { m_halt = true; }

  /** Called at once with every emergency stop, from the server's threads; set before the robot
   * drives; may be empty. */
  std::function<void()> onEmergency;

  /** Shows what the robot sees and does. */
  void show(const MissionScene &scene);

  /** The map has changed, or may have: shows it and carries out what waits for that. */
  void follow(MapFile &file, const std::vector<std::string> &log);

  /**
   * The robot stands and its mission has ended, or was halted. Carries out commands until one is to
   * drive or Ctrl-C ends it.
   * @param words why it stands
   * @param resumable whether there is something to go on with
   */
  NextDrive await(MapFile &file, const std::string &words, bool resumable);

private:
  /** A command that waits for the thread of the map. */
  struct Waiting
  {
    PageCommand command;
    std::promise<PageAnswer> answer;
  };

  PageAnswer obey(const PageCommand &command);
  PageAnswer obeyLater(const PageCommand &command);
  std::optional<PageFile> find(const std::string &path) const;
  void publishRobot();
  void publishMap(const MapFile &file);
  void workOff(MapFile &file, NextDrive *next);
  PageAnswer carryOut(const PageCommand &command, MapFile &file, NextDrive *next);

  bool m_drives;
  std::atomic<bool> m_halt{false};
  mutable std::mutex m_mutex;
  std::condition_variable m_changed;
  std::deque<Waiting> m_waiting;               ///< under m_mutex, as all below
  std::string m_words = "begins";              ///< why it stands
  bool m_stands = false;                       ///< until somebody wants a drive
  bool m_resumable = false;                    ///< see await()
  bool m_emergency = false;                    ///< nothing drives until it is released
  std::map<std::int64_t, std::string> m_views; ///< JPEG by node
  std::deque<std::string> m_log;
  PageServer m_server; ///< last: its threads use all of the above
};

} // namespace homeward
