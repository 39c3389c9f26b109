// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/visual_compass.h>

#include <opencv2/core/mat.hpp>

#include <optional>

namespace homeward
{

/** Two panoramas as seen with one heading, for methods that need a compass. */
struct AlignedViews
{
  PanoramaGeometry geometry; ///< of both pictures
  cv::Mat current;           ///< gray levels, CV_32F
  cv::Mat snapshot;          ///< the same, turned to the heading of the current view
  CompassReading compass;    ///< by visualCompass() on coarse log intensities
};

/**
 * Both pictures on a small grid of the elevations that both show, the snapshot turned by what the
 * visual compass reads.
 * @param width, height of that grid
 * @return nothing when the compass has no answer
 * @throw LogicError for an empty picture, a wrong type or size, or elevations without overlap
 */
std::optional<AlignedViews> alignByCompass(const Panorama &current, const Panorama &snapshot,
                                           int width, int height);

} // namespace homeward
