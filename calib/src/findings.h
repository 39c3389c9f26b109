// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robust_fit.h"

#include <homeward/calib/calibration.h>

#include <cstddef>
#include <string>
#include <vector>

namespace homeward
{

/** The views that can say something, and why the others cannot. */
struct UsableViews
{
  BoardViews views;
  std::vector<std::size_t> leftOut; ///< of the views given, ascending
  std::vector<std::string> warnings;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero(); ///< radialCentre(), pixels
  bool solid = false;                               ///< some view's points do not lie in one plane
};

/**
 * Leaves out views with too few points, with points on a line, and those that no pose explains.
 * @throw ConfigError when fewer than three are left; LogicError when points and pixels differ in
 * number or are no numbers
 */
UsableViews usableViews(const BoardViews &views);

/** @throw ConfigError when the fit explains nothing or all views are alike */
void refuseImpossible(const BoardViews &views, const RobustFit &fit);

/** Adds handedness, eccentricity and the warnings about what the views leave open. */
void addFindings(const BoardViews &views, bool solid, Calibration &calibration);

/** Warns of views that the camera does not predict when they are left out. */
void addLonelyViews(const BoardViews &views, Calibration &calibration);

} // namespace homeward
