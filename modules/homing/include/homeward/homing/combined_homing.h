// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/bearing_homing.h>
#include <homeward/homing/min_warping.h>

namespace homeward
{

/** What CombinedHoming may be told. */
struct CombinedHomingOptions
{
  double sure = 0.5;        ///< min-warping of at least this confidence is not checked, [0, 1]
  double bearingSure = 0.5; ///< bearings of less confidence do not overrule it, [0, 1]
};

/**
 * Min-warping, and the bearings of matched features where it is unsure and they are not.
 *
 * Min-warping answers first; that is all where its confidence reaches `sure`. Otherwise the answer
 * is BearingHoming's if its confidence reaches `bearingSure`, else min-warping's (or nothing) as it
 * is. The defaults are set by the project's own worlds (laboratory, rooms, corridors; day, night,
 * two lamps): min-warping is less sure than that in a quarter of the pairs, which then take the
 * time of both; of 1733 answers by bearings at least that sure, half a degree off on average, one
 * leads away from home. In rooms where both are unsure it is no better than min-warping.
 */
class CombinedHoming : public HomingMethod
{
public:
  /** @throw LogicError for options out of range */
  explicit CombinedHoming(const CombinedHomingOptions &options = {});

  std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) override;

private:
  CombinedHomingOptions m_options;
  MinWarping m_warping;
  BearingHoming m_bearing;
};

} // namespace homeward
