// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace homeward
{

/** What a localizer believed after one view. */
struct BeliefRow
{
  std::vector<double> belief;       ///< by place, 0 to 1
  std::optional<std::size_t> truth; ///< the place where the view was taken, where known
};

/**
 * Beliefs one below the other: across the places, down the views; the darker, the surer; a ring
 * where the truth is.
 * @return CV_8UC3
 * @throw LogicError without views or places, or when the number of places changes
 */
cv::Mat beliefPicture(const std::vector<BeliefRow> &rows);

} // namespace homeward
