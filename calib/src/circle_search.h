// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/mirror_circles.h>

#include <vector>

namespace homeward
{

/** A circle and the share of it, where the picture shows it, that lies on an edge. */
struct SupportedCircle
{
  Circle circle;
  double support = 0.0; ///< 0 to 1
};

/** Circles round the middle of a smoothed picture, the best supported first. */
std::vector<SupportedCircle> searchCircles(const cv::Mat1b &smooth);

} // namespace homeward
