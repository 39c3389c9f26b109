// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/sim/simulator.h>

namespace homeward
{

/** Puts the robot somewhere. @return false, and it stays, where it does not fit */
bool putAt(Simulator &simulator, const Pose2 &pose);

/**
 * Whether the robot can stand at a place and turn there: one that is wedged in cannot leave. It is
 * put there to see.
 */
bool hasRoom(Simulator &simulator, const Pose2 &place);

} // namespace homeward
