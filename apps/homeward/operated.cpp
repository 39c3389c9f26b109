// SPDX-License-Identifier: GPL-3.0-or-later
#include "operated.h"

#include "mission_setup.h"
#include "real_robot.h"
#include "stop_signal.h"

#include <cstdio>

namespace homeward
{
namespace
{

void say(const std::string &line)
{
  endProgress();
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

/** Asks until the motors are on. @return false when a stop was asked for instead */
bool motorsAreOn(RealRobot &robot, OperatorInput &hands)
{
  while (true) {
    say("the robot stands, its motors are off; press g to go on, s to end here");
    if (!hands.awaitGo()) {
      return false;
    }
    try {
      robot.base().enableMotors();
      return true;
    }
    catch (const DeviceError &error) {
      say(error.what());
    }
  }
}

} // namespace

std::unique_ptr<OperatorInput> makeOperator(MissionRobot &robot, const RobotArguments &arguments)
{
  if (!robot.runsByItself()) {
    return nullptr;
  }
  auto hands = std::make_unique<OperatorInput>(
      arguments.joystick.empty() ? robot.files().rig.devices->stopJoystick : arguments.joystick);
  if (hands->hasKeys()) {
    say("s or space stops the robot");
  }
  return hands;
}

bool mended(const DeviceError &fault, MissionRobot &robot, OperatorInput *hands,
            const RobotArguments &arguments)
{
  const std::atomic<bool> &stop = stopSignal();
  RealRobot *real = robot.real();
  if (real == nullptr || hands == nullptr || !hands->hasKeys() || arguments.reconnect == 0 ||
      stop || real->baseFault().empty()) {
    return false;
  }
  say(std::string("fault: ") + fault.what());
  ReconnectOptions options;
  options.tries = arguments.reconnect;
  if (!real->bringBack(options, stop, say)) {
    return false;
  }
  // After a stop the mission finds it asked for, and ends as it does then.
  motorsAreOn(*real, *hands);
  return true;
}

} // namespace homeward
