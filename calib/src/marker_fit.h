// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "markers.h"
#include "point_refinement.h"

#include <opencv2/core/mat.hpp>

#include <array>
#include <optional>

namespace homeward
{

/**
 * The corners of a marker on white paper, from all its edges at once: the four corners, brightness,
 * contrast and blur that make its known cells look most like the picture, by Gauss-Newton.
 * @param toPicture from the marker's own frame, corners (0, 0) to (1, 1), to the picture; to half a
 * cell
 * @return clockwise from (0, 0); nothing where the picture shows no such marker
 */
std::optional<std::array<Eigen::Vector2d, 4>>
fitMarker(const cv::Mat1b &picture, const MarkerCells &cells, const ToPicture &toPicture);

} // namespace homeward
