// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/column_features.h>
#include <homeward/homing/homing_method.h>

#include <vector>

namespace homeward
{

class ScalePlanes;

/** What MinWarping may be told. */
struct MinWarpingOptions
{
  int columns = 144;        ///< resolution of the search round the full turn; even, 8 to 360
  int rows = 80;            ///< edge values in a column
  int planes = 9;           ///< scale planes; odd, 3 to 31
  double scaleMax = 2.0;    ///< magnification of the outermost planes, > 1
  double scaleLimit = 2.5;  ///< matches that need a larger magnification are left out
  bool doubleSearch = true; ///< search both ways round; two to three times fewer errors
  int searchStep = 1; ///< columns from one searched direction to the next; divides columns / 2
  double compassShare = 1.0; ///< share of heading changes searched, the best by a compass, (0, 1]
};

/** The most accurate setting, not the fastest: finer in direction and in scale, and farther. */
inline constexpr MinWarpingOptions kThoroughWarping{288, 80, 23, 2.6, 3.2, true, 1, 1.0};

/** The answer of MinWarping with what it knows about its own quality. */
struct WarpingMatch
{
  HomeVector home; ///< that the best warping says
  /**
   * Mean column distance of the best warping, 0 (same) to 1: a place-recognition distance that
   * tolerates displacement and a change of light.
   */
  double matchDistance = 1.0;
  double contrast = 1.0;      ///< best sum over median sum; small is distinct
  double headingRatio = 1.0;  ///< best sum over the best at a heading change 20 degrees off
  double oppositeRatio = 1.0; ///< best sum over the best at directions more than 60 degrees off
};

/**
 * Min-warping: the movement (direction and turn) under which every column of the snapshot finds,
 * at a distance of its own choice, its best partner in the current view.
 *
 * With alpha the direction of the current place seen from the snapshot, psi the heading change and
 * x = theta - alpha, a landmark at snapshot azimuth theta appears at theta + delta - psi magnified
 * by sin(x + delta) / sin(x). M(alpha, psi) = sum over theta of the minimum over delta of the
 * column distance is searched exhaustively; home lies at alpha + pi - psi. \cite Moeller2010
 */
class MinWarping : public HomingMethod
{
public:
  /** @throw LogicError for options out of range */
  explicit MinWarping(const MinWarpingOptions &options = {});

  std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) override;

  /** The work that depends on one panorama alone; keep it to compare that panorama often. */
  ColumnFeatures prepare(const Panorama &panorama) const;

  /**
   * As compute(), on prepared panoramas.
   * @throw LogicError when either was prepared with other options
   */
  std::optional<WarpingMatch> match(const ColumnFeatures &current,
                                    const ColumnFeatures &snapshot) const;

  /** As it was made. */
  const MinWarpingOptions &options() const { return m_options; }

private:
  struct Candidate
  {
    int delta; ///< columns, signed
    int plane; ///< index of the scale plane
  };

  /** Candidates of one plane at 2^level neighbouring deltas. */
  struct Window
  {
    int run;   ///< level * planes + plane
    int delta; ///< the first, columns, from 0 to columns - 1
  };

  class Sums;
  struct Minimum;

  void buildTemplate();
  void buildWindows();
  std::vector<bool> likelyTurns(const ScalePlanes &forward) const;
  void accumulate(const ScalePlanes &planes, const std::vector<bool> &turns, bool swapped,
                  Sums &sums) const;
  Minimum findMinimum(const Sums &sums) const;
  double distanceProxy(const ScalePlanes &forward, const Minimum &minimum) const;
  WarpingMatch describe(const ScalePlanes &forward, const Sums &sums, const Minimum &minimum) const;

  MinWarpingOptions m_options;
  ColumnFeatureOptions m_featureOptions;
  /** m_template[x]: matches that a landmark at angle x (columns) off alpha admits. */
  std::vector<std::vector<Candidate>> m_template;
  /** m_windows[x]: the same, neighbours together. */
  std::vector<std::vector<Window>> m_windows;
};

} // namespace homeward
