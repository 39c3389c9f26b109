// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>

#include <Eigen/Geometry>

namespace homeward
{

/** A planar pose as a motion in space, on the floor. */
inline Eigen::Isometry3d lift(const Pose2 &aMb)
{
  Eigen::Isometry3d spatial = Eigen::Isometry3d::Identity();
  spatial.translate(Eigen::Vector3d(aMb.x, aMb.y, 0.0));
  spatial.rotate(Eigen::AngleAxisd(aMb.heading, Eigen::Vector3d::UnitZ()));
  return spatial;
}

} // namespace homeward
