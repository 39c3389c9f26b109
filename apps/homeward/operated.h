// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mission_robot.h"
#include "operator_input.h"

#include <homeward/core/error.h>

#include <memory>

namespace homeward
{

/** The operator of a robot that drives by itself; null in simulation, where nobody can be hurt. */
std::unique_ptr<OperatorInput> makeOperator(MissionRobot &robot, const RobotArguments &arguments);

/**
 * Offers the operator to go on after a fault of the base: brings a lost one back, within
 * RobotArguments::reconnect tries, and waits for the key g before its motors are switched on.
 * @return whether the mission is to be run on; false for faults of other devices, without an
 * operator who has keys, and after a stop
 * @throw DeviceError when the base does not come back
 */
bool mended(const DeviceError &fault, MissionRobot &robot, OperatorInput *hands,
            const RobotArguments &arguments);

/** Runs a mission, and on after each fault that was mended, or was when it was recorded. @throw
 * DeviceError after any other */
template <class Mission>
auto runOperated(MissionRobot &robot, OperatorInput *hands, const RobotArguments &arguments,
                 Mission mission)
{
  while (true) {
    try {
      return mission();
    }
    catch (const DeviceError &fault) {
      if (!robot.wentOn() && !mended(fault, robot, hands, arguments)) {
        throw;
      }
    }
  }
}

} // namespace homeward
