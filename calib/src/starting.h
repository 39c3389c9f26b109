// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/bundle.h>
#include <homeward/calib/calibration.h>

#include <optional>

namespace homeward
{

/** Unified model without distortion and poses near the optimum, from the best of several starts. */
struct Started
{
  BundleState state;
  double cost = 0.0; ///< Huber, pixels^2
};

/**
 * @param centre radialCentre()
 * @param given a model to try beside the starts that need none, or nullptr
 * @return nothing when no start comes to an end
 */
std::optional<Started> findStart(const BoardViews &views, const Eigen::Vector2d &centre,
                                 const CameraModel *given, int starts);

} // namespace homeward
