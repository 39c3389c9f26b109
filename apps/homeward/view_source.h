// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulated_robot.h"

#include <homeward/evaluation/rendered_views.h>

namespace homeward
{

/** What takes pictures for data sets as the robot's camera would. */
ViewSource viewSource(const SimulatedRobot &robot, const SimulationArguments &arguments);

/** Shows on standard error how many pictures are taken, when that is a terminal. */
Progress renderProgress();

} // namespace homeward
