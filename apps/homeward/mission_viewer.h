// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dashboard.h"
#include "mission_robot.h"

#include <homeward/mission/command.h>
#include <homeward/pilot/pilot.h>
#include <homeward/viewer/mission_picture.h>

#include <memory>
#include <string>
#include <vector>

namespace homeward
{

/** How a mission is shown. */
struct ViewArguments
{
  bool windows = false; ///< of ViSP
  std::string video;    ///< file; empty: none
  std::string serve;    ///< [HOST:]PORT of a page; empty: none

  bool any() const { return windows || !video.empty() || !serve.empty(); }
};

/** `--view`, `--video` and `--serve`. */
void addViewOptions(CliCommand command, ViewArguments &arguments);

/** What the robot does to carry out a command, in words. */
std::string commandWords(const Command &command);

/**
 * The page of a mission, its address printed; null where none is wanted.
 * @throw ConfigError, also where the mission is recorded: what is commanded at the page would not
 * be in the recording
 */
std::unique_ptr<Dashboard> openDashboard(const ViewArguments &arguments,
                                         const RobotArguments &settings, MissionRobot &robot);

/**
 * Shows a mission while it runs, in windows, as a video or in browsers, drawn by a thread of its
 * own. Of a robot that runs by itself pictures are left out rather than waited for; simulated time
 * waits for every one of a window or a video.
 */
class MissionViewer
{
public:
  /**
   * What it shows at once and what it then looks at.
   * @param dashboard null: nobody looks on from a browser; paused when Ctrl-C is pressed
   * @throw ConfigError when the windows or the video cannot be opened
   */
  MissionViewer(const ViewArguments &arguments, MissionRobot &robot,
                const OpenDirectionOptions &directions, Dashboard *dashboard);
  ~MissionViewer();

  /** The robot's, for the mission to use. */
  Devices devices();

  /** Looks on as it decides; before its first command. */
  void watch(Pilot &pilot);

  /** A line on what was decided, and why. */
  void say(const std::string &line);

  /**
   * The mission has taken a step.
   * @param poses true ones of the nodes; empty where nobody knows
   * @param route the nodes on its way
   */
  void step(const TopologicalMap &map, const std::map<NodeId, Pose2> &poses,
            const std::vector<NodeId> &route, const std::string &state);

private:
  class Screen;
  class Watched;
  std::unique_ptr<Screen> m_screen;
  std::unique_ptr<Watched> m_watched;
};

/** One for what is asked for; null where nothing is. Throws as its constructor. */
std::unique_ptr<MissionViewer> openViewer(const ViewArguments &arguments, MissionRobot &robot,
                                          const OpenDirectionOptions &directions,
                                          Dashboard *dashboard);

} // namespace homeward
