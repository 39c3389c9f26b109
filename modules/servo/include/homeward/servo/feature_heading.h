// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/servo/visp_types.h>

namespace homeward
{

/** Heading of the robot against that of the home place: s = (psi), rad; d psi / dt = wz of p. */
class FeatureHeading : public vpBasicFeature
{
public:
  FeatureHeading();

  /** @throw LogicError unless finite */
  void set(double psi);

  /** The heading, radians. */
  double psi() const { return s[0]; }

  void init() override;

  /** The 1 x 6 matrix from the twist (vx, vy, vz, wx, wy, wz) of p to ds/dt. */
  vpMatrix interaction(unsigned int select = FEATURE_ALL) override;

  /** s - wanted in [-pi, pi). */
  vpColVector error(const vpBasicFeature &wanted, unsigned int select = FEATURE_ALL) override;

  /** An arrow from the picture's middle along the home heading, forward being up. */
  void display(const vpCameraParameters &cam, const vpImage<unsigned char> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;
  void display(const vpCameraParameters &cam, const vpImage<vpRGBa> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;

  void print(unsigned int select = FEATURE_ALL) const override;

  FeatureHeading *duplicate() const override;
};

} // namespace homeward
