// SPDX-License-Identifier: GPL-3.0-or-later
#include "mission_viewer.h"

#include "real_robot.h"
#include "stop_signal.h"
#include "view_window.h"

#include <homeward/core/error.h>

#include <opencv2/videoio.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>

namespace homeward
{
namespace
{

constexpr double kPeriod = 0.5; // seconds of robot time from one picture to the next
constexpr double kRate = 25.0;  // pictures a second in the video
constexpr double kKept = 30.0;  // seconds that the speeds go back

/** Where the scenes go: windows, a video, a page. Used by one thread at a time. */
class Picturing
{
public:
  Picturing(const ViewArguments &arguments, Dashboard *dashboard)
      : m_windowed(arguments.windows), m_file(arguments.video), m_dashboard(dashboard)
  {
    const MissionScene nothingYet;
    if (!m_file.empty()) {
      const bool avi = m_file.ends_with(".avi");
      const int code = avi ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G')
                           : cv::VideoWriter::fourcc('m', 'p', '4', 'v');
      if (!avi && !m_file.ends_with(".mp4")) {
        throw ConfigError("--video " + m_file + ": the name must end with .mp4 or .avi");
      }
      if (!m_video.open(m_file, code, kRate, {kMissionWidth, kMissionHeight})) {
        throw ConfigError("--video " + m_file + " cannot be written");
      }
    }
    if (m_windowed) {
      openWindows(missionImages(nothingYet));
    }
  }

  void show(const MissionScene &scene)
  {
    if (m_windowed) {
      const std::vector<TitledImage> images = missionImages(scene);
      for (std::size_t i = 0; i < images.size(); ++i) {
        m_windows[i]->show(images[i].image);
      }
    }
    if (m_video.isOpened()) {
      m_video.write(missionImage(scene));
    }
    if (m_dashboard != nullptr) {
      m_dashboard->show(scene);
    }
  }

private:
  void openWindows(const std::vector<TitledImage> &images)
  {
    constexpr int kTitleBar = 40; // pixels
    int x = 0;
    int y = 0;
    for (const TitledImage &one : images) {
      m_windows.push_back(std::make_unique<ViewWindow>("Homeward: " + one.title, one.image, x, y));
      x = y == 0 ? 0 : x + one.image.cols;
      y = y == 0 ? one.image.rows + kTitleBar : y;
    }
  }

  bool m_windowed;
  std::string m_file;
  Dashboard *m_dashboard;
  std::vector<std::unique_ptr<ViewWindow>> m_windows;
  cv::VideoWriter m_video;
};

} // namespace

/** The scene as it stands, and the thread that draws it. */
class MissionViewer::Screen
{
public:
  Screen(const ViewArguments &arguments, MissionRobot &robot,
         const OpenDirectionOptions &directions, Dashboard *dashboard)
      : m_robot(robot), m_directions(directions), m_dashboard(dashboard),
        m_waits(!robot.runsByItself() && (arguments.windows || !arguments.video.empty())),
        m_begin(robot.watch()), m_due(m_begin), m_picturing(arguments, dashboard),
        m_thread([this] { draw(); })
  {}

  ~Screen()
  {
    post(); // how it ended
    {
      const std::lock_guard lock(m_mutex);
      m_over = true;
    }
    m_changed.notify_all();
    m_thread.join();
    saySpent();
  }

  Screen(const Screen &) = delete;
  Screen &operator=(const Screen &) = delete;

  /** Changes the scene, from any thread. */
  template <class Change> void update(Change change)
  {
    const std::lock_guard lock(m_mutex);
    change(m_scene);
  }

  /** The base was told something: a tick of the control loop. */
  void tick(const Twist2 &told)
  {
    if (m_dashboard != nullptr && stopSignal()) {
      m_dashboard->pause();
    }
    const Time now = m_robot.watch();
    update([&](MissionScene &scene) {
      scene.seconds = toSeconds(now - m_begin);
      scene.speeds.push_back({scene.seconds, told, m_measured, scene.sure});
      while (scene.speeds.front().seconds < scene.seconds - kKept) {
        scene.speeds.pop_front();
      }
    });
    if (now >= m_due) {
      m_due = now + fromSeconds(kPeriod);
      post();
    }
  }

  void measured(const Twist2 &twist) { m_measured = twist; }

  /** Something new was seen, from any thread. */
  void sees(const Sighting &seen)
  {
    update([&](MissionScene &scene) {
      scene.view = seen.view;
      scene.goal = seen.goal ? "node " + std::to_string(seen.goal->value) : std::string();
      scene.home = seen.home ? std::optional(seen.home->direction) : std::nullopt;
      scene.sure = seen.home ? seen.home->confidence : 0.0;
      scene.alike.clear();
      for (const PlaceMatch &match : seen.matches) {
        scene.alike.emplace_back(match.node, match.probability);
      }
      m_viewed = scene.seconds;
    });
  }

  /** There is a new scan. */
  void scans(const Scan &scan)
  {
    update([&](MissionScene &scene) {
      scene.scan = scan;
      m_scanned = scene.seconds;
    });
  }

  /** What looking on took of a tick. */
  void spent(std::chrono::duration<double, std::milli> time)
  {
    constexpr std::size_t kMost = 1000000;
    if (m_spent.size() < kMost) {
      m_spent.push_back(static_cast<float>(time.count()));
    }
  }

  /** Says what looking on took of the ticks of a robot that waits for nobody. */
  void saySpent()
  {
    if (m_waits || m_spent.empty()) {
      return;
    }
    std::sort(m_spent.begin(), m_spent.end());
    std::printf("looking on took %.3f ms of 99 %% of %zu ticks, at most %.3f ms\n",
                m_spent[m_spent.size() * 99 / 100], m_spent.size(), m_spent.back());
  }

private:
  /** Hands the scene to the thread. */
  void post()
  {
    std::optional<Pose2> truth;
    std::optional<double> battery;
    if (RealRobot *real = m_robot.real()) {
      battery = real->base().battery();
    }
    else if (m_robot.truth()) {
      truth = m_robot.truth()->pose;
    }
    std::unique_lock lock(m_mutex);
    m_scene.robot = truth;
    m_scene.battery = battery;
    m_scene.viewAge = m_scene.seconds - m_viewed;
    m_scene.scanAge = m_scene.seconds - m_scanned;
    if (m_next && !m_waits) {
      return; // the one before is not even begun
    }
    m_changed.wait(lock, [this] { return !m_next || m_failed; });
    m_next = m_scene;
    lock.unlock();
    m_changed.notify_all();
  }

  void draw()
  {
    std::unique_lock lock(m_mutex);
    while (true) {
      m_changed.wait(lock, [this] { return m_next || m_over; });
      if (!m_next) {
        return;
      }
      MissionScene scene = *std::exchange(m_next, std::nullopt);
      lock.unlock();
      m_changed.notify_all();
      if (scene.scan) {
        scene.openDirections = findOpenDirections(*scene.scan, m_directions);
      }
      const bool shown = show(scene);
      lock.lock();
      if (!shown) {
        m_failed = true;
        m_changed.notify_all();
        return;
      }
    }
  }

  /** A window that somebody closes must not end the mission. */
  bool show(const MissionScene &scene)
  {
    try {
      m_picturing.show(scene);
      return true;
    }
    catch (const std::exception &error) {
      std::fprintf(stderr, "homeward: the mission goes on unseen: %s\n", error.what());
      return false;
    }
  }

  MissionRobot &m_robot;
  OpenDirectionOptions m_directions;
  Dashboard *m_dashboard;
  bool m_waits; ///< for every picture
  Time m_begin;
  Time m_due;
  Twist2 m_measured;
  std::vector<float> m_spent; ///< ms of each tick
  Picturing m_picturing;
  std::mutex m_mutex;
  std::condition_variable m_changed;
  MissionScene m_scene;               ///< under m_mutex, as all below
  std::optional<MissionScene> m_next; ///< to be drawn
  double m_viewed = 0.0;              ///< seconds, see MissionScene
  double m_scanned = 0.0;             ///< seconds
  bool m_over = false;
  bool m_failed = false; ///< nothing is drawn any more
  std::thread m_thread;
};

/** Devices that are looked at while they work. */
class MissionViewer::Watched
{
public:
  Watched(const Devices &devices, Screen &screen)
      : m_devices(devices), m_base(devices.base, screen), m_laser(devices.laser, screen)
  {}

  Devices devices() { return {m_devices.clock, m_base, m_laser, m_devices.camera}; }

private:
  class Base final : public MobileBase
  {
  public:
    Base(MobileBase &base, Screen &screen) : m_base(base), m_screen(screen) {}

    void drive(const Twist2 &twist) override
    {
      m_base.drive(twist);
      const auto begin = std::chrono::steady_clock::now();
      m_screen.tick(twist);
      m_screen.spent(std::chrono::steady_clock::now() - begin);
    }

    BaseState state() override
    {
      BaseState state = m_base.state();
      m_screen.measured(state.velocity);
      return state;
    }

  private:
    MobileBase &m_base;
    Screen &m_screen;
  };

  class Laser final : public LaserScanner
  {
  public:
    Laser(LaserScanner &laser, Screen &screen) : m_laser(laser), m_screen(screen) {}

    std::optional<Scan> scan() override
    {
      std::optional<Scan> scan = m_laser.scan();
      if (scan) {
        m_screen.scans(*scan);
      }
      return scan;
    }

  private:
    LaserScanner &m_laser;
    Screen &m_screen;
  };

  Devices m_devices;
  Base m_base;
  Laser m_laser;
};

void addViewOptions(CliCommand command, ViewArguments &arguments)
{
  command.flag("--view", arguments.windows,
               "Show in windows what the robot sees, its map and how it drives");
  command.option("--video", arguments.video,
                 "Write the same as a video, .mp4 or .avi; each second of it is 12.5 s");
  command.option("--serve", arguments.serve,
                 "[HOST:]PORT of a page that shows it in browsers and takes commands; 0: any port");
}

std::unique_ptr<Dashboard> openDashboard(const ViewArguments &arguments,
                                         const RobotArguments &settings, MissionRobot &robot)
{
  if (arguments.serve.empty()) {
    return nullptr;
  }
  if (!settings.record.file.empty()) {
    throw ConfigError("--serve and --record exclude each other: what is commanded at the page "
                      "would not be in the recording");
  }
  auto dashboard = std::make_unique<Dashboard>(arguments.serve, settings.replay.empty());
  if (RealRobot *real = robot.real()) {
    dashboard->onEmergency = [real] {
      try {
        real->base().emergencyStop();
      }
      catch (const DeviceError &) { // whose line is gone stops by itself
      }
    };
  }
  std::printf("open %s\n", dashboard->url().c_str());
  std::fflush(stdout);
  return dashboard;
}

std::string commandWords(const Command &command)
{
  struct Words
  {
    std::string operator()(const Survey &) const { return "looks all round: a new place"; }
    std::string operator()(const DriveDirection &) const { return "drives where it is open"; }
    std::string operator()(const Recognise &) const { return "asks which place this is"; }
    std::string operator()(const HomeTo &home) const
    {
      return "drives home to node " + std::to_string(home.node.value) + " by sight";
    }
    std::string operator()(const Finish &finish) const
    {
      return std::string(name(finish.outcome)) + ": " + finish.reason;
    }
  };
  return std::visit(Words{}, command);
}

MissionViewer::MissionViewer(const ViewArguments &arguments, MissionRobot &robot,
                             const OpenDirectionOptions &directions, Dashboard *dashboard)
    : m_screen(std::make_unique<Screen>(arguments, robot, directions, dashboard)),
      m_watched(std::make_unique<Watched>(robot.devices(), *m_screen))
{}

std::unique_ptr<MissionViewer> openViewer(const ViewArguments &arguments, MissionRobot &robot,
                                          const OpenDirectionOptions &directions,
                                          Dashboard *dashboard)
{
  return arguments.any() ? std::make_unique<MissionViewer>(arguments, robot, directions, dashboard)
                         : nullptr;
}

MissionViewer::~MissionViewer() = default;

Devices MissionViewer::devices()
{
  return m_watched->devices();
}

void MissionViewer::watch(Pilot &pilot)
{
  pilot.onSight = [this](const Sighting &seen) { m_screen->sees(seen); };
}

void MissionViewer::say(const std::string &line)
{
  m_screen->update([&](MissionScene &scene) { scene.reason = line; });
}

void MissionViewer::step(const TopologicalMap &map, const std::map<NodeId, Pose2> &poses,
                         const std::vector<NodeId> &route, const std::string &state)
{
  auto copy = std::make_shared<const TopologicalMap>(map);
  m_screen->update([&](MissionScene &scene) {
    scene.map = std::move(copy);
    scene.poses = poses;
    scene.route = route;
    scene.state = state;
    scene.goal.clear();
    scene.home.reset();
    scene.sure = 0.0;
  });
}

} // namespace homeward
