// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/homing_method.h>

namespace homeward
{

/** What DescentInImageDistance may be told. */
struct ImageDescentOptions
{
  int columns = 180; ///< of the grid both views are brought to, at least 36
  int rows = 40;     ///< likewise, at least 16
  double blur = 0.2; ///< standard deviation of the low-pass filter, rad
};

/**
 * Home by descent in image distance, predicted instead of driven: matched filters.
 *
 * Views differ more the farther apart they are, so their squared difference falls towards home. Its
 * gradient needs no trial movements: with landmarks all round at one distance, a movement t (in
 * units of it) shifts what stands at (azimuth, elevation) by
 *
 *     d azimuth = t_x sin(azimuth) - t_y cos(azimuth),
 *     d elevation = sin(elevation) cos(elevation) (t_x cos(azimuth) + t_y sin(azimuth)),
 *
 * and the slopes of the picture tell what that does to its intensity. The movement that best
 * explains the difference, by one Gauss-Newton step, is undone. Compared are low-pass filtered
 * logarithms of intensity without their mean. \cite Moeller2006
 *
 * A baseline to compare with: light that shines from elsewhere looks like a movement. It has no
 * compass of its own and first turns the snapshot by visualCompass() on coarse log
 * intensities, which is right near home only; where that is wrong, so is this. headingChange is the
 * compass's, confidence the compass's times the root of the share of the difference that the
 * movement explains. distanceProxy is the length of t, at most 3.
 */
class DescentInImageDistance : public HomingMethod
{
public:
  /** @throw LogicError for options out of range */
  explicit DescentInImageDistance(const ImageDescentOptions &options = {});

  std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) override;

private:
  ImageDescentOptions m_options;
};

} // namespace homeward
