// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>

#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/vs/vpServo.h>

#include <functional>

namespace homeward
{

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

/** Twist of p from (vx, vy, wz). */
inline vpMatrix freePlanarJacobian()
{
  vpMatrix eJe(6, 3);
  eJe[0][0] = 1.0;
  eJe[1][1] = 1.0;
  eJe[5][2] = 1.0;
  return eJe;
}

/**
 * A camera that flies freely in the plane, servoed from `start` (hMp) on `now` and `wanted`.
 * @param look renews `now` at a pose
 * @return hMp after so many steps of 0.2 s at gain 1
 */
inline Pose2 flyHome(vpBasicFeature &now, vpBasicFeature &wanted, const Pose2 &start, int steps,
                     const std::function<void(const Pose2 &)> &look)
{
  constexpr double kPeriod = 0.2;
  vpServo task;
  task.setServo(vpServo::EYEINHAND_L_cVe_eJe);
  task.setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
  task.setLambda(1.0);
  task.set_cVe(vpVelocityTwistMatrix());
  task.set_eJe(freePlanarJacobian());
  task.addFeature(now, wanted);
  Pose2 hMp = start;
  for (int step = 0; step < steps; ++step) {
    look(hMp);
    const vpColVector v = task.computeControlLaw();
    hMp = hMp * Pose2{v[0] * kPeriod, v[1] * kPeriod, v[2] * kPeriod};
  }
  return hMp;
}

} // namespace homeward
