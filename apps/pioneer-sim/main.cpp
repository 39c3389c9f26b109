// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"
#include "mirror_feed.h"
#include "simulated_pioneer.h"
#include "simulated_robot.h"
#include "stop_signal.h"
#include "web_server.h"

#include "files.h"

#include <homeward/core/error.h>
#include <homeward/sim/true_optics.h>

#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <filesystem>

namespace homeward
{
namespace
{

struct Arguments
{
  SimulationArguments simulation;
  PioneerSimOptions pioneer;
  int httpPort = 0;
  double frameRate = 5.0; ///< Hz of robot time
  std::string links;
};

void addOptions(CliCommand app, Arguments &arguments)
{
  addSimulationArguments(app, arguments.simulation);
  constexpr int kLastPort = 65535;
  app.option("--host", arguments.pioneer.host, "IPv4 address to listen on").showDefault();
  app.option("--port", arguments.pioneer.port, "TCP port of the robot; 0: the system chooses")
      .between(0, kLastPort)
      .showDefault();
  app.option("--http-port", arguments.httpPort, "Port of the camera; 0: the system chooses")
      .between(0, kLastPort)
      .showDefault();
  app.option("--speed", arguments.pioneer.speed, "Seconds of its life in one of ours")
      .between(0.1, 50.0)
      .showDefault();
  app.option("--frame-rate", arguments.frameRate, "Pictures a second of its life")
      .between(0.1, 100.0)
      .showDefault();
  app.option("--subclass", arguments.pioneer.arcos.subclass, "p3at or p3at-sh").showDefault();
  app.option("--links", arguments.links,
             "Folder for the links 'pioneer' and 'lms200' to the serial lines");
}

void link(const std::string &folder, const std::string &name, const std::string &target)
{
  namespace fs = std::filesystem;
  if (folder.empty()) {
    return;
  }
  std::error_code error;
  const fs::path path = fs::path(folder) / name;
  if (fs::is_symlink(path)) {
    fs::remove(path, error);
  }
  fs::create_symlink(target, path, error);
  if (error) {
    throw ConfigError("cannot make the link " + path.string() + ": " + error.message());
  }
}

nlohmann::json poseJson(const Pose2 &pose)
{
  return {pose.x, pose.y, pose.heading};
}

/** One simulated robot with everything that it serves. */
class PioneerSim
{
public:
  explicit PioneerSim(const Arguments &arguments)
      : m_arguments(arguments), m_robot(arguments.simulation),
        m_pioneer(m_robot.simulator(), arguments.pioneer, m_faults),
        m_feed(
            renderer(), m_robot.robot().rMp, [this] { return m_pioneer.snapshot().truth.pose; },
            arguments.simulation.seed, feedOptions(), m_faults),
        m_start(m_robot.simulator().truth().pose), m_web(
                                                       arguments.pioneer.host, arguments.httpPort,
                                                       m_feed, [this] { return truth(); }, m_faults)
  {
    link(arguments.links, "pioneer", m_pioneer.arcosPty());
    link(arguments.links, "lms200", m_pioneer.lmsPty());
  }

  /** Says, in one line of JSON, where it can be reached. */
  void announce() const
  {
    const nlohmann::json json = {{"arcos_port", m_pioneer.port()},
                                 {"arcos_pty", m_pioneer.arcosPty()},
                                 {"lms_pty", m_pioneer.lmsPty()},
                                 {"http_port", m_web.port()},
                                 {"speed", m_arguments.pioneer.speed}};
    std::printf("%s\n", json.dump().c_str());
    std::fflush(stdout);
  }

  void run(const std::atomic<bool> &stop) { m_pioneer.run(stop); }

private:
  MirrorRenderer renderer() const
  {
    RenderOptions options;
    options.threads = m_arguments.simulation.threads;
    const LightPreset light = parseLightPreset(m_arguments.simulation.light);
    return {m_robot.sharedScene(), lightingFor(light, m_robot.scene()),
            drawOptics(m_robot.camera(), m_arguments.simulation.seed), options};
  }

  MirrorFeedOptions feedOptions() const
  {
    MirrorFeedOptions options;
    options.period = fromSeconds(1.0 / (m_arguments.frameRate * m_arguments.pioneer.speed));
    return options;
  }

  std::string truth() const
  {
    const SimulatedPioneer::Snapshot now = m_pioneer.snapshot();
    const nlohmann::json json = {{"sim_time_s", toSeconds(now.now)},
                                 {"pose", poseJson(now.truth.pose)},
                                 {"start", poseJson(m_start)},
                                 {"v_m_s", now.velocity.v},
                                 {"w_rad_s", now.velocity.w},
                                 {"distance_m", now.truth.distance},
                                 {"collisions", now.truth.collisions},
                                 {"unseen_contacts", now.truth.unseenContacts},
                                 {"world", m_robot.worldFile()},
                                 {"robot", m_robot.files().robotFile},
                                 {"light", m_arguments.simulation.light},
                                 {"seed", m_arguments.simulation.seed}};
    return json.dump();
  }

  const Arguments &m_arguments;
  SimulatedRobot m_robot;
  Faults m_faults;
  SimulatedPioneer m_pioneer;
  MirrorFeed m_feed;
  Pose2 m_start;
  WebServer m_web;
};

void simulate(Arguments &arguments)
{
  arguments.simulation.laser.step = radians(0.5); // what a LMS-200 can do
  arguments.pioneer.arcos.limits = kPioneer3AtLimits;
  PioneerSim sim(arguments);
  const std::atomic<bool> &stop = stopSignal(); // before anybody can know whom to stop
  sim.announce();
  sim.run(stop);
}

} // namespace
} // namespace homeward

int main(int argc, char **argv)
{
  std::signal(SIGPIPE, SIG_IGN);
  homeward::Program program(
      "pioneer-sim", "A simulated Pioneer behind its real protocols: ARCOS, LMS-200, MJPEG.");
  program.examples(
      "Example: pioneer-sim --world data/worlds/lab.sdf --port 8101 --http-port 8102\n"
      "It says in one line of JSON where it can be reached, and runs until it is stopped.");
  homeward::Arguments arguments;
  homeward::addOptions(program, arguments);
  program.run([&arguments] {
    homeward::simulate(arguments);
    return homeward::kExitDone;
  });
  return program.main(argc, argv);
}
