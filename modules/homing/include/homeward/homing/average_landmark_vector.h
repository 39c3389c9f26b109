// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/homing_method.h>

namespace homeward
{

/** What AverageLandmarkVector may be told. */
struct AverageLandmarkOptions
{
  int columns = 360;          ///< of the grid both views are brought to, at least 36
  int rows = 60;              ///< likewise, at least 16
  double band = 0.1;          ///< elevations up to here above and below the horizon, rad
  double edgeContrast = 0.05; ///< slope of the log intensity from column to column that counts
};

/**
 * Home by the average landmark vector: the mean of the unit vectors to all landmarks, here the
 * upright edges along the horizon, needs no matching. The difference between its values here and at
 * home, both in one compass frame, points home:
 *
 *     ALV = sum over edges of (cos(azimuth), sin(azimuth)) / number of edges,
 *     home = ALV(current) - ALV(snapshot).
 *
 * A baseline to compare with: it takes all landmarks to be seen from both places. It has no compass
 * of its own and first turns the snapshot by visualCompass() on coarse log intensities, which is
 * right near home only; where that is wrong, so is this. headingChange and confidence are the
 * compass's, and say nothing of the landmarks. distanceProxy is twice the length of the difference,
 * the distance over that of landmarks evenly spread around. \cite Lambrinos2000
 */
class AverageLandmarkVector : public HomingMethod
{
public:
  /** @throw LogicError for options out of range */
  explicit AverageLandmarkVector(const AverageLandmarkOptions &options = {});

  std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) override;

private:
  AverageLandmarkOptions m_options;
};

} // namespace homeward
