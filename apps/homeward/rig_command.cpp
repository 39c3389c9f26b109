// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "rig_check.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <cstdio>
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

/** The operator's word that the robot may move. */
bool confirmed()
{
  std::printf("The robot will turn left by 30 degrees and drive 15 cm ahead. Is there a metre free "
              "round it? Type yes: ");
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
    if (!confirmed()) {
      throw RuntimeError("not confirmed: the robot has not moved");
    }
    good = report(checkMotion(files), json);
  }
  json["outcome"] = good ? "done" : "failed";
  writeJson(arguments.json, json);
  return good ? kExitDone : kExitFailed;
}

} // namespace

void addRigCommand(CliCommand app)
{
  CliCommand rig = app.command("rig", "Look after the robot that a rig file names");
  rig.requireCommand();
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
