// SPDX-License-Identifier: GPL-3.0-or-later
#include "has_room.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

namespace homeward
{

bool putAt(Simulator &simulator, const Pose2 &pose)
{
  try {
    simulator.kidnap(pose);
    return true;
  }
  catch (const ConfigError &) {
    return false;
  }
}

bool hasRoom(Simulator &simulator, const Pose2 &place)
{
  constexpr int kHeadings = 8;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = wrapAngle(place.heading + i * 2.0 * kPi / kHeadings);
    if (!putAt(simulator, {place.x, place.y, heading})) {
      return false;
    }
  }
  return true;
}

} // namespace homeward
