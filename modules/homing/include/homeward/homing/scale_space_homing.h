// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/homing_method.h>

#include <opencv2/core/types.hpp>

#include <vector>

namespace homeward
{

/** What ScaleSpaceHoming may be told. */
struct ScaleSpaceOptions
{
  /** cv::SIFT, and every feature compared with every other: many times slower, no more accurate. */
  bool published = false;
  double contrastThreshold = 0.015; ///< of the detector, of all gray levels; less finds more
  double matchRatio = 0.8;          ///< best over second best descriptor distance, (0, 1)
  int mostKeypoints = 800;          ///< of each panorama, the strongest
  int leastMatches = 6;             ///< fewer give no answer
};

/** The features of one panorama. */
struct ScaleSpaceView
{
  PanoramaGeometry geometry;        ///< of the panorama
  std::vector<cv::KeyPoint> points; ///< x in columns of the panorama
  cv::Mat descriptors;              ///< a row for each: CV_8U of upright features, CV_32F of SIFT
};

/**
 * Home in scale space: landmarks whose scale grew since the snapshot lie where we went, those
 * that shrank lie towards home.
 *
 * With n_c, b_c (n_e, b_e) number and circular mean bearing of the contracted (expanded) matches,
 *
 *     home = atan2(n_c sin(b_c) + n_e sin(b_e + pi), n_c cos(b_c) + n_e cos(b_e + pi))
 *
 * It needs no compass. distanceProxy comes from the median |log scale ratio|, headingChange from
 * the circular median of the matches' turns. \cite Churchill2013
 *
 * Features are extrema of differences of Gaussians with histograms of gradients, as of SIFT,
 * upright and compared with those only that stand where a landmark can have come to on a level
 * floor.
 */
class ScaleSpaceHoming : public HomingMethod
{
public:
  /** @throw LogicError for options out of range */
  explicit ScaleSpaceHoming(const ScaleSpaceOptions &options = {});

  std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) override;

  /** The work that depends on one panorama alone; keep it to compare that panorama often. */
  ScaleSpaceView prepare(const Panorama &panorama) const;

  /** As compute(), on prepared panoramas. */
  std::optional<HomeVector> match(const ScaleSpaceView &current,
                                  const ScaleSpaceView &snapshot) const;

private:
  ScaleSpaceOptions m_options;
};

} // namespace homeward
