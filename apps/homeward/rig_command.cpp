// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "mission_robot.h"
#include "mission_setup.h"
#include "mount_drive.h"
#include "operated.h"
#include "rig_check.h"
#include "stop_signal.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

namespace homeward
{
namespace
{

struct CheckArguments
{
  std::string rig;
  double clockRate = 0.0;
  double seconds = 3.0;
  bool move = false;
  std::string json;
};

/** The operator's word that the robot may move. @param what it will do, and the room it needs */
bool confirmed(const char *what)
{
  std::printf("The robot will %s? Type yes: ", what);
  std::fflush(stdout);
  std::string word;
  return std::getline(std::cin, word) && word == "yes";
}

/** Prints each finding. @return whether all are good */
bool report(const std::vector<Finding> &findings, nlohmann::json &json)
{
  bool good = true;
  for (const Finding &finding : findings) {
    std::printf("%-6s %s: %s\n", finding.device.c_str(), finding.good ? "ok" : "BAD",
                finding.text.c_str());
    json["findings"].push_back(
        {{"device", finding.device}, {"good", finding.good}, {"text", finding.text}});
    good = good && finding.good;
  }
  return good;
}

int check(const CheckArguments &arguments)
{
  RobotFiles files = loadRobotFiles(arguments.rig);
  if (!files.rig.devices) {
    throw ConfigError(arguments.rig + ": names no devices (base, laser, capture), so there is " +
                      "nothing to check");
  }
  if (arguments.clockRate != 0.0) {
    files.rig.devices->clockRate = arguments.clockRate;
  }
  nlohmann::json json = jsonHeader("rig");
  json["findings"] = nlohmann::json::array();
  bool good = report(checkDevices(files, arguments.seconds), json);
  if (arguments.move && good) {
    if (!confirmed(
            "turn left by 30 degrees and drive 15 cm ahead. Is there a metre free round it")) {
      throw RuntimeError("not confirmed: the robot has not moved");
    }
    const OperatorInput hands(files.rig.devices->stopJoystick);
    good = report(checkMotion(files, stopSignal()), json);
  }
  json["outcome"] = good ? "done" : "failed";
  writeJson(arguments.json, json);
  return good ? kExitDone : kExitFailed;
}

struct DriveArguments
{
  RobotArguments robot;
  std::string folder;
};

int drive(const DriveArguments &arguments)
{
  if (std::filesystem::exists(arguments.folder)) {
    throw ConfigError(arguments.folder + ": is there already; name a new folder");
  }
  const auto robot = makeMissionRobot(arguments.robot);
  if (robot->runsByItself() &&
      !confirmed(
          "turn once on the spot and drive up to 1.5 m ahead. Are two metres free round it")) {
    throw RuntimeError("not confirmed: the robot has not moved");
  }
  const RobotFiles &files = robot->files();
  const std::unique_ptr<OperatorInput> hands = makeOperator(*robot, arguments.robot);
  try {
    const DataSet set =
        driveForMount(robot->devices(), files.robot, files.camera, {}, stopSignal(),
                      [](int taken) { showProgress("picture " + std::to_string(taken)); });
    endProgress();
    set.write(arguments.folder);
    std::printf("%zu pictures; wrote %s\n", set.size(), arguments.folder.c_str());
  }
  catch (const StopRequested &) {
    throw RuntimeError("stopped; the robot stands, nothing is written");
  }
  return kExitDone;
}

void addDriveCommand(CliCommand rig)
{
  auto arguments = std::make_shared<DriveArguments>();
  CliCommand command =
      rig.command("drive", "A turn on the spot and a straight line, for homeward-calibrate mount");
  command.examples("Example: homeward rig drive drive/ --rig my_rig.yaml");
  command.option("folder", arguments->folder, "Data set folder to write").required();
  addRobotArguments(command, arguments->robot);
  command.remove("--truth");
  command.remove("--reconnect");
  command.run([arguments] { return drive(*arguments); });
}

} // namespace

void addRigCommand(CliCommand app)
{
  CliCommand rig = app.command("rig", "Look after the robot that a rig file names");
  rig.requireCommand();
  addDriveCommand(rig);
  auto arguments = std::make_shared<CheckArguments>();
  CliCommand command = rig.command("check", "Test every device; nothing moves unless asked");
  command.examples("Example: homeward rig check my_rig.yaml --move");
  command.option("rig", arguments->rig, "Rig file").required();
  command
      .option("--clock-rate", arguments->clockRate,
              "The --speed of a pioneer-sim (default: as the rig says)")
      .positive();
  command.option("--seconds", arguments->seconds, "How long each device is listened to")
      .between(0.5, 600.0)
      .showDefault();
  command.flag("--move", arguments->move,
               "Then turn and drive a hand's width, when you have said yes");
  command.json(arguments->json, "a summary");
  command.run([arguments] { return check(*arguments); });
}

} // namespace homeward
