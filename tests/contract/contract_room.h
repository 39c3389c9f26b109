// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "test_room.h"

#include <homeward/core/pose2.h>
#include <homeward/core/scan.h>

#include <cmath>

namespace homeward
{

/** Where the robot of the contract tests starts: wMr. */
inline constexpr Pose2 kContractStart{4.0, 5.0, 0.0};

/**
 * A room of 10 m x 10 m with one red post of 40 x 40 cm, whose middle is 2 m ahead and 2 m to the
 * left of kContractStart.
 *
 *   +-------------------+
 *   |                   |
 *   |           #       |
 *   |                   |
 *   |       r>          |
 *   |                   |
 *   |                   |
 *   +-------------------+
 */
inline Scene contractRoom()
{
  Scene scene = makeRoom(10.0F, 10.0F);
  addBox(scene, {5.8F, 6.8F, 0.0F}, {6.2F, 7.2F, 2.0F}, {0.8F, 0.02F, 0.02F});
  return scene;
}

/** A direction and how far it is to there. */
struct Sighting
{
  double bearing = 0.0; ///< radians
  double range = 0.0;   ///< metres
};

/** The nearest thing that a laser sees, faults left out; in contractRoom() it is the post. */
inline Sighting nearestIn(const Scan &scan)
{
  constexpr float kFault = 0.15F; // metres
  Sighting nearest{0.0, scan.rangeMax};
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (scan.ranges[i] > kFault && scan.ranges[i] < nearest.range) {
      nearest = {scan.angle(i), scan.ranges[i]};
    }
  }
  return nearest;
}

/** The reading nearest to `bearing` that is known and no fault; rangeMax without one. */
inline double rangeAt(const Scan &scan, double bearing)
{
  constexpr double kNear = radians(3.0);
  double best = scan.rangeMax;
  double offset = kNear;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double off = std::abs(wrapAngle(scan.angle(i) - bearing));
    if (off < offset && scan.ranges[i] > 0.15F && scan.ranges[i] < scan.rangeMax) {
      best = scan.ranges[i];
      offset = off;
    }
  }
  return best;
}

} // namespace homeward
