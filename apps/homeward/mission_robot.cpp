// SPDX-License-Identifier: GPL-3.0-or-later
#include "mission_robot.h"

#include "real_robot.h"
#include "recording.h"
#include "remote_truth.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/restless_world.h>

namespace homeward
{
namespace
{

class InProcess final : public MissionRobot
{
public:
  InProcess(const RobotArguments &arguments, std::optional<Pose2> start)
      : m_robot(arguments.simulation, start), m_world{m_robot.worldFile(),
                                                      arguments.simulation.light,
                                                      arguments.simulation.seed}
  {
    if (arguments.restless > 0) {
      m_restless.emplace(m_robot.simulator(), m_robot.sharedScene(),
                         Restlessness{.people = arguments.restless}, arguments.simulation.seed);
    }
  }

  Devices devices() override { return m_robot.devices(); }
  const RobotFiles &files() const override { return m_robot.files(); }
  RealRobot *real() override { return nullptr; }
  std::optional<SimulatedWorld> world() const override { return m_world; }
  std::optional<Truth> truth() const override { return m_robot.simulator().truth(); }
  const FreeSpace *freeSpace() override { return &m_robot.simulator().freeSpace(); }

private:
  SimulatedRobot m_robot;
  SimulatedWorld m_world;
  std::optional<RestlessWorld> m_restless;
};

class Connected final : public MissionRobot
{
public:
  Connected(RobotFiles files, const std::string &truth)
      : m_files(std::move(files)), m_robot(m_files)
  {
    if (!truth.empty()) {
      m_truth = std::make_unique<RemoteTruth>(truth, m_files);
    }
  }

  Devices devices() override { return m_robot.devices(); }
  const RobotFiles &files() const override { return m_files; }
  RealRobot *real() override { return &m_robot; }

  std::optional<SimulatedWorld> world() const override
  {
    return m_truth ? std::optional(m_truth->world()) : std::nullopt;
  }

  std::optional<Truth> truth() const override
  {
    return m_truth ? std::optional(m_truth->now()) : std::nullopt;
  }

  const FreeSpace *freeSpace() override { return m_truth ? &m_truth->freeSpace() : nullptr; }

private:
  RobotFiles m_files;
  RealRobot m_robot;
  std::unique_ptr<RemoteTruth> m_truth;
};

/** As makeMissionRobot(), neither recorded nor replayed. */
std::unique_ptr<MissionRobot> makePresentRobot(const RobotArguments &arguments,
                                               std::optional<Pose2> start)
{
  RobotFiles files = loadRobotFiles(arguments.simulation.rig);
  if (!files.rig.devices) {
    if (arguments.clockRate != 0.0 || !arguments.truth.empty()) {
      throw ConfigError("--clock-rate and --truth need a rig with real devices, and " +
                        files.rigFile.string() + " has none");
    }
    return std::make_unique<InProcess>(arguments, start);
  }
  if (!arguments.simulation.world.empty() || !arguments.simulation.start.empty()) {
    throw ConfigError("the rig " + files.rigFile.string() +
                      " is a real one: it has no --world and no --start");
  }
  if (arguments.restless > 0) {
    throw ConfigError("the rig " + files.rigFile.string() +
                      " is a real one: its people come by themselves, without --restless");
  }
  if (arguments.clockRate != 0.0) {
    files.rig.devices->clockRate = arguments.clockRate;
  }
  return std::make_unique<Connected>(std::move(files), arguments.truth);
}

} // namespace

void addRestless(CliCommand command, std::size_t &people)
{
  command
      .option("--restless", people,
              "So many people walk about in the simulated world, and its chairs get moved")
      .between(0, 1000);
}

void addRobotArguments(CliCommand command, RobotArguments &arguments)
{
  addSimulationArguments(command, arguments.simulation);
  command
      .option("--clock-rate", arguments.clockRate,
              "The --speed of the pioneer-sim that a real rig names (default: as the rig says)")
      .positive();
  command.option("--truth", arguments.truth,
                 "Judge the mission by what a pioneer-sim at this URL knows");
  command.option(
      "--joystick", arguments.joystick,
      "/dev/input/jsN: any of its buttons stops a real robot (default: as the rig says)");
  command
      .option("--reconnect", arguments.reconnect,
              "Tries to bring the lost base of a real robot back; then the key g goes on. 0: none")
      .between(0, 1000)
      .showDefault();
  addRestless(command, arguments.restless);
}

std::unique_ptr<MissionRobot> makeMissionRobot(const RobotArguments &arguments,
                                               std::optional<Pose2> start,
                                               const nlohmann::json &mission)
{
  if (!arguments.replay.empty()) {
    return replayedRobot(arguments.replay);
  }
  std::unique_ptr<MissionRobot> robot = makePresentRobot(arguments, start);
  return arguments.record.file.empty() ? std::move(robot)
                                       : recordedRobot(std::move(robot), arguments.record, mission);
}

} // namespace homeward
