// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording.h"

#include "stop_signal.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#ifdef HOMEWARD_BAGS
#include <homeward/bag/bag_reader.h>
#include <homeward/bag/bag_repair.h>
#include <homeward/bag/tick_reader.h>
#include <homeward/bag/tick_recorder.h>
#include <homeward/record/recording_devices.h>
#include <homeward/record/replayed_devices.h>

#include <cstdio>
#endif

namespace homeward
{

void addRecordOptions(CliCommand command, RecordArguments &arguments)
{
  command.option("--record", arguments.file,
                 "Write what the robot reads and is told into this ROS 1 bag, for homeward replay");
  command
      .option("--record-split", arguments.splitMegabytes,
              "Megabytes after which the recording goes on in a bag of its own, F_1.bag and so on")
      .between(1.0, 1e6)
      .showDefault();
}

std::filesystem::path mapBefore(const std::string &bag)
{
  return bag + ".hwm";
}

void keepMapBefore(const MapFile &map, const std::string &bag)
{
  MapFile kept = MapFile::copyOf(map, mapBefore(bag), MapFile::IfExists::Replace);
  kept.append(MapUpdate{});
  kept.close();
}

void refuseBags()
{
  throw ConfigError("this program was built without ROS bags; install librosbag-storage-dev, "
                    "libsensor-msgs-dev and libnav-msgs-dev and build it again");
}

#ifdef HOMEWARD_BAGS

namespace
{

/** What RobotFiles are made of. */
nlohmann::json filesJson(const RobotFiles &files)
{
  return {{"rig_file", files.rigFile.string()},
          {"rig", files.rigText},
          {"robot", files.robotText},
          {"camera", files.cameraText}};
}

RobotFiles filesFrom(const nlohmann::json &json)
{
  return parseRobotFiles(json.at("rig_file").get<std::string>(), json.at("rig").get<std::string>(),
                         json.at("robot").get<std::string>(), json.at("camera").get<std::string>());
}

class RecordedRobot final : public MissionRobot
{
public:
  RecordedRobot(std::unique_ptr<MissionRobot> robot, const RecordArguments &arguments,
                const nlohmann::json &mission)
      : m_robot(std::move(robot)),
        m_recorder(arguments.file, setup(*m_robot, mission).dump(), options(*m_robot, arguments)),
        m_real(m_robot->devices()),
        m_devices(m_real.clock, m_real.base, m_real.laser, m_real.camera, stopSignal(),
                  [this](Tick tick) { m_recorder.keep(std::move(tick)); })
  {}

  ~RecordedRobot() override { m_devices.finish(); }

  RecordedRobot(const RecordedRobot &) = delete;
  RecordedRobot &operator=(const RecordedRobot &) = delete;

  Devices devices() override
  {
    return {m_devices.clock(), m_devices.base(), m_devices.laser(), m_devices.camera()};
  }
  const RobotFiles &files() const override { return m_robot->files(); }
  RealRobot *real() override { return m_robot->real(); }
  bool runsByItself() override { return m_robot->runsByItself(); }
  Time watch() override { return m_robot->watch(); }
  std::optional<SimulatedWorld> world() const override { return m_robot->world(); }
  std::optional<Truth> truth() const override { return m_robot->truth(); }
  const FreeSpace *freeSpace() override { return m_robot->freeSpace(); }
  void note(const nlohmann::json &event) override { m_devices.note(event.dump()); }

  bool finish(nlohmann::json &summary) override
  {
    m_devices.finish();
    const RecordingCounts counts = m_recorder.finish();
    std::printf("recorded %zu ticks, %.1f MB", counts.ticks,
                static_cast<double>(counts.bytes) / 1e6);
    if (counts.lostPictures + counts.lostTicks > 0) {
      std::printf("; there was no room for %zu pictures and %zu ticks", counts.lostPictures,
                  counts.lostTicks);
    }
    std::printf("\n");
    if (!counts.problem.empty()) {
      std::printf("the recording ended early: %s\n", counts.problem.c_str());
    }
    summary["recording"] = {{"ticks", counts.ticks},
                            {"bytes", counts.bytes},
                            {"lost_pictures", counts.lostPictures},
                            {"lost_ticks", counts.lostTicks},
                            {"problem", counts.problem}};
    return true;
  }

private:
  static nlohmann::json setup(MissionRobot &robot, const nlohmann::json &mission)
  {
    return {{"mission", mission},
            {"robot", filesJson(robot.files())},
            {"runs_by_itself", robot.runsByItself()}};
  }

  static RecorderOptions options(MissionRobot &robot, const RecordArguments &arguments)
  {
    RecorderOptions options;
    options.fileBytes = static_cast<std::uint64_t>(1e6 * arguments.splitMegabytes);
    options.mayWait = !robot.runsByItself(); // simulated time stands still meanwhile
    return options;
  }

  std::unique_ptr<MissionRobot> m_robot;
  TickRecorder m_recorder;
  Devices m_real;
  RecordingDevices m_devices;
};

class ReplayedRobot final : public MissionRobot
{
public:
  explicit ReplayedRobot(const std::string &bag)
      : m_ticks(bagParts(bag)), m_setup(nlohmann::json::parse(m_ticks.setup())),
        m_files(filesFrom(m_setup.at("robot"))),
        m_devices([this] { return m_ticks.next(); }, askToStop)
  {}

  Devices devices() override
  {
    return {m_devices.clock(), m_devices.base(), m_devices.laser(), m_devices.camera()};
  }
  const RobotFiles &files() const override { return m_files; }
  RealRobot *real() override { return nullptr; }
  bool runsByItself() override { return m_setup.at("runs_by_itself").get<bool>(); }
  bool wentOn() override { return !m_devices.atEnd(); }
  Time watch() override { return m_devices.now(); }
  std::optional<SimulatedWorld> world() const override { return std::nullopt; }
  std::optional<Truth> truth() const override { return std::nullopt; }
  const FreeSpace *freeSpace() override { return nullptr; }

  bool finish(nlohmann::json &summary) override
  {
    const std::optional<Divergence> divergence = m_devices.divergence();
    const std::optional<Time> missed = m_devices.missedPicture();
    nlohmann::json &json = summary["replay"];
    json = {{"same", !divergence}, {"whole", m_devices.atEnd()}};
    if (missed) {
      json["missed_picture_s"] = toSeconds(*missed);
      std::printf("a picture was not recorded at %.3f s; the one before stood in for it\n",
                  toSeconds(*missed));
    }
    if (divergence) {
      json["diverged_s"] = toSeconds(divergence->at);
      std::printf("robot time %.3f s: the first command that differs: recorded %s, now %s\n",
                  toSeconds(divergence->at), text(divergence->recorded).c_str(),
                  text(divergence->now).c_str());
      return false;
    }
    std::printf("every command was as recorded\n");
    return true;
  }

private:
  static std::string text(const std::optional<Twist2> &twist)
  {
    if (!twist) {
      return "none";
    }
    char said[80];
    std::snprintf(said, sizeof said, "%.6g m/s, %.6g rad/s", twist->v, twist->w);
    return said;
  }

  TickReader m_ticks;
  nlohmann::json m_setup;
  RobotFiles m_files;
  ReplayedDevices m_devices;
};

} // namespace

std::unique_ptr<MissionRobot> recordedRobot(std::unique_ptr<MissionRobot> robot,
                                            const RecordArguments &arguments,
                                            const nlohmann::json &mission)
{
  return std::make_unique<RecordedRobot>(std::move(robot), arguments, mission);
}

nlohmann::json recordedMission(const std::string &bag)
{
  return nlohmann::json::parse(TickReader(bagParts(bag)).setup()).at("mission");
}

std::unique_ptr<MissionRobot> replayedRobot(const std::string &bag)
{
  return std::make_unique<ReplayedRobot>(bag);
}

std::optional<RobotFiles> recordedFiles(const std::string &bag)
{
  BagReader reader(bag);
  const std::optional<BagMessage> first = reader.next();
  const auto *event = first ? std::get_if<BagEvent>(&first->what) : nullptr;
  if (event == nullptr) {
    return std::nullopt;
  }
  const nlohmann::json told = nlohmann::json::parse(event->json, nullptr, false);
  return told.is_object() && told.value("event", "") == "recording"
             ? std::optional(filesFrom(told.at("setup").at("robot")))
             : std::nullopt;
}

std::string repairRecording(const std::string &bag)
{
  const BagRepair repair = repairBag(bag);
  if (!repair.needed) {
    return bag + " has its index";
  }
  return bag + ": " + std::to_string(repair.messages) + " messages in " +
         std::to_string(repair.chunks) + " chunks kept, " + std::to_string(repair.cutBytes) +
         " bytes of what was not closed cut off";
}

#else

std::unique_ptr<MissionRobot> recordedRobot(std::unique_ptr<MissionRobot> /*robot*/,
                                            const RecordArguments & /*arguments*/,
                                            const nlohmann::json & /*mission*/)
{
  refuseBags();
}

nlohmann::json recordedMission(const std::string & /*bag*/)
{
  refuseBags();
}

std::unique_ptr<MissionRobot> replayedRobot(const std::string & /*bag*/)
{
  refuseBags();
}

std::string repairRecording(const std::string & /*bag*/)
{
  refuseBags();
}

std::optional<RobotFiles> recordedFiles(const std::string & /*bag*/)
{
  refuseBags();
}

#endif

} // namespace homeward
