// SPDX-License-Identifier: GPL-3.0-or-later
#include "pose_step.h"

#include <homeward/camera/visp_bridge.h>

#include <visp3/core/vpColVector.h>
#include <visp3/core/vpExponentialMap.h>

namespace homeward
{

Eigen::Isometry3d moved(const Eigen::Isometry3d &cMo, const CameraTwist &twist)
{
  vpColVector velocity(6);
  for (unsigned int i = 0; i < 6; ++i) {
    velocity[i] = twist[i];
  }
  Eigen::Isometry3d next = fromVisp(vpExponentialMap::direct(velocity)).inverse() * cMo;
  next.linear() = Eigen::Quaterniond(next.linear()).normalized().toRotationMatrix();
  return next;
}

} // namespace homeward
