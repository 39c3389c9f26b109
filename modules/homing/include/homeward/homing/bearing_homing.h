// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/homing_method.h>
#include <homeward/homing/scale_space_homing.h>

namespace homeward
{

/** What BearingHoming may be told. */
struct BearingHomingOptions
{
  ScaleSpaceOptions features = {}; ///< what is matched; its leastMatches is not used
  double tolerance = radians(1.0); ///< bearings that miss by more are wrong matches, rad
  int mostSamples = 1000;          ///< pairs of matches tried
  int leastMatches = 8;            ///< fewer give no answer
  int leastInliers = 6;            ///< fewer matches that agree give no answer
};

/**
 * Home from the bearings of matched features, by the geometry of two views on one floor.
 *
 * With c and s the unit vectors to a landmark in the current view and in the snapshot, alpha the
 * bearing of the current place seen from the snapshot and psi the heading change, every landmark
 * meets (R(psi) c) . (d x s) = 0, d = (cos(alpha), sin(alpha), 0), and has been displaced away from
 * d. The movement that most matches agree with is found two matches at a time and refined by robust
 * least squares; home lies at alpha + pi - psi. It needs no compass, and no more than a few right
 * matches among many wrong ones. \cite Ortin2001
 *
 * distanceProxy is the median over the inliers of sin(parallax) / sin(bearing off d), at most 3.
 * confidence grows with the inliers, with their lead over the best direction more than 60 degrees
 * off and with how well the bearings determine the direction. At the place itself no direction
 * stands out: the confidence is low, the heading change is right.
 */
class BearingHoming : public HomingMethod
{
public:
  /** @throw LogicError for options out of range */
  explicit BearingHoming(const BearingHomingOptions &options = {});

  std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) override;

  /** The work that depends on one panorama alone; keep it to compare that panorama often. */
  ScaleSpaceView prepare(const Panorama &panorama) const;

  /** As compute(), on prepared panoramas. */
  std::optional<HomeVector> match(const ScaleSpaceView &current,
                                  const ScaleSpaceView &snapshot) const;

private:
  BearingHomingOptions m_options;
  ScaleSpaceHoming m_features;
};

} // namespace homeward
