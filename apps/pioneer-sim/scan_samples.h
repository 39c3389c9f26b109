// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/scan.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace homeward
{

/** The words of a wire format for what is no range. */
struct RangeWords
{
  std::uint16_t unknown = 0; ///< nothing measured
  std::uint16_t far = 0;     ///< beyond the sensor's range
};

/**
 * The readings of a scan nearest to the angles start + i * step, as whole counts.
 * @param start, step radians, counter-clockwise from forward
 * @param unit metres per count; a range of `words.far` counts and more is far
 */
inline std::vector<std::uint16_t> sampleScan(const Scan &scan, double start, double step,
                                             std::size_t count, double unit,
                                             const RangeWords &words)
{
  std::vector<std::uint16_t> counts;
  counts.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at =
        (start + static_cast<double>(i) * step - scan.angleMin) / scan.angleStep + 0.5;
    const bool seen = at >= 0.0 && at < static_cast<double>(scan.ranges.size());
    const float range = seen ? scan.ranges[static_cast<std::size_t>(at)] : kUnknownRange;
    if (std::isnan(range)) {
      counts.push_back(words.unknown);
      continue;
    }
    const double scaled = std::round(range / unit);
    const bool far = range >= scan.rangeMax || scaled >= words.far;
    counts.push_back(far ? words.far : static_cast<std::uint16_t>(scaled));
  }
  return counts;
}

} // namespace homeward
