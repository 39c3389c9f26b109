// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulated_robot.h"

#include <homeward/evaluation/changed_scene.h>
#include <homeward/evaluation/rendered_views.h>

namespace homeward
{

/** What takes pictures for data sets as the robot's camera would. */
ViewSource viewSource(const SimulatedRobot &robot, const SimulationArguments &arguments);

/** `--people`, `--move-furniture`. */
void addSceneChange(CliCommand command, SceneChange &change);

/** Has the pictures taken after a change, and says what has changed; nothing without one. */
void applyChange(ViewSource &source, const SimulatedRobot &robot, const std::vector<Pose2> &views,
                 const SceneChange &change);

/** Shows on standard error how many pictures are taken, when that is a terminal. */
Progress renderProgress();

} // namespace homeward
