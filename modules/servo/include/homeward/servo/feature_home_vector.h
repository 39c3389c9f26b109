// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/servo/visp_types.h>

namespace homeward
{

/**
 * Home place in polar coordinates of frame p (the mirror's focus): s = (rho, beta), in any length
 * unit and rad, counter-clockwise from forward. With the twist of p,
 *
 *     d rho / dt  = -vx cos(beta) - vy sin(beta)
 *     d beta / dt = (vx sin(beta) - vy cos(beta)) / rho - wz
 *
 * Singular at rho = 0. Lengths of rho and of the twist must be in one unit.
 */
class FeatureHomeVector : public vpBasicFeature
{
public:
  FeatureHomeVector();

  /** Selects rho in interaction(), error(), vpServo::addFeature(). */
  static unsigned int selectRho() { return FEATURE_LINE[0]; }

  /** Selects beta. */
  static unsigned int selectBeta() { return FEATURE_LINE[1]; }

  /** @throw LogicError unless rho > 0 and both are finite */
  void set(double rho, double beta);

  /** The distance proxy. */
  double rho() const { return s[0]; }
  /** The direction of home, radians. */
  double beta() const { return s[1]; }

  void init() override;

  /** Selected rows of the 2 x 6 matrix from the twist (vx, vy, vz, wx, wy, wz) of p to ds/dt. */
  vpMatrix interaction(unsigned int select = FEATURE_ALL) override;

  /** s - wanted of the selected rows, the angle in [-pi, pi). */
  vpColVector error(const vpBasicFeature &wanted, unsigned int select = FEATURE_ALL) override;

  /** An arrow from the picture's middle towards home, forward being up. */
  void display(const vpCameraParameters &cam, const vpImage<unsigned char> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;
  void display(const vpCameraParameters &cam, const vpImage<vpRGBa> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;

  void print(unsigned int select = FEATURE_ALL) const override;

  FeatureHomeVector *duplicate() const override;
};

} // namespace homeward
