// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scale_planes.h"

#include <cstdint>
#include <vector>

namespace homeward
{

/**
 * Minima of ScalePlanes over runs of shifts: a landmark at one angle may match any of a run of
 * shifts, and a run is the union of a few windows of these lengths.
 */
class ShiftWindows
{
public:
  static constexpr int kLevels = 4; ///< windows of 1, 2, 4 and 8 shifts

  explicit ShiftWindows(const ScalePlanes &planes);

  /**
   * min over s = shift to shift + 2^level - 1 of ScalePlanes::row(plane, s).
   * @param run level * planes + plane
   * @param shift from 0 to columns - 1
   */
  const std::uint8_t *row(int run, int shift) const
  {
    const std::size_t index =
        static_cast<std::size_t>(run) * m_columns + static_cast<std::size_t>(shift);
    return &m_bytes[index * 2U * m_columns];
  }

private:
  std::size_t m_columns;
  std::vector<std::uint8_t> m_bytes;
};

} // namespace homeward
