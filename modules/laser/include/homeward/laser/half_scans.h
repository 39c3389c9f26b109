// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/scan.h>

#include <Eigen/Geometry>

#include <vector>

namespace homeward
{

/** A scan in the laser's frame and where the robot was when it was taken. */
struct PlacedScan
{
  Scan scan; ///< in its own frame
  Pose2 mMr; ///< robot in the merged frame, the robot's own when the node's picture was taken
};

/**
 * All scans as one of 360 readings, one a degree from -pi, seen from the origin of the merged
 * frame. Reading i stands for the directions within half a degree of angle(i).
 *
 * The nearest of several readings wins. A hole between neighbouring readings of one scan that stand
 * within 3 degrees is filled between them (laser and robot do not share a centre). Readings at or
 * beyond their scan's rangeMax are far and open: rangeMax in the direction they point, unless
 * something nearer stands there. Readings below 0.1 m are faults of the sensor. What no scan has
 * seen is unknown.
 *
 * @param rMl the laser in the robot's frame; it may be turned or upside down
 * @return stamp of the last scan, the largest rangeMax
 * @throw LogicError without a scan
 */
Scan joinScans(const std::vector<PlacedScan> &scans, const Eigen::Isometry3d &rMl);

} // namespace homeward
