// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/servo/visp_types.h>

#include <Eigen/Core>

#include <vector>

namespace homeward
{

/** Where a point stands as seen from p. */
struct SphericalBearing
{
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX(); ///< unit vector in frame p
  double range = 1.0;                                   ///< > 0, metres; a rough one will do
};

/**
 * Bearings of n points on the unit sphere of frame p (the mirror's focus): s = (s_1, ..., s_n),
 * dimension 3n. With the twist (v, w) of p and ranges r_i,
 *
 *     ds_i / dt = -(I - s_i s_i^T) / r_i v + [s_i]x w
 *
 * The error is the chord s_i - s*_i. The columns of L lie in the tangent planes at s_i, so a law
 * with the current L sees of a chord what lies in them: the sine of the angle between s_i and s*_i.
 * Points are matched by their order. Ranges scale the translation alone; with the same factor wrong
 * everywhere the law still comes home, only slower or faster.
 *
 * There are more rows than vpBasicFeature has flags: as in vpFeatureLuminance a selection is
 * ignored and all rows are taken. With 6 to 10 points ViSP's own get_s() and getDimension() hide
 * rows beyond the 16th unless ~0U is asked for; error(), interaction() and vpServo's law do not.
 * \cite Hamel2002
 */
class FeatureSphericalBearings : public vpBasicFeature
{
public:
  FeatureSphericalBearings();

  /**
   * @throw LogicError without a point, or when a direction is not of length 1 (to 1e-6) or a range
   * is not finite and positive
   */
  void set(const std::vector<SphericalBearing> &bearings);

  /** As they were set. */
  const std::vector<SphericalBearing> &bearings() const { return m_bearings; }

  /** No points. */
  void init() override;

  /** The 3n x 6 matrix from the twist (vx, vy, vz, wx, wy, wz) of p to ds/dt. */
  vpMatrix interaction(unsigned int select = FEATURE_ALL) override;

  /** s - wanted. @throw LogicError when `wanted` has another number of points */
  vpColVector error(const vpBasicFeature &wanted, unsigned int select = FEATURE_ALL) override;

  /** A cross for each point: the sphere seen from above, forward being up. */
  void display(const vpCameraParameters &cam, const vpImage<unsigned char> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;
  void display(const vpCameraParameters &cam, const vpImage<vpRGBa> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;

  void print(unsigned int select = FEATURE_ALL) const override;

  FeatureSphericalBearings *duplicate() const override;

private:
  std::vector<SphericalBearing> m_bearings;
};

} // namespace homeward
