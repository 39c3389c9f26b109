// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace homeward
{

/** How sums of absolute differences become bytes: min(most, sum * factor / 65536). */
struct DistanceScale
{
  std::uint16_t factor = 0;
  std::uint16_t most = 255;
};

/**
 * distances[i] = the scaled sum over r of |first[r * firstStride + i] - second[r * secondStride +
 * i]|, for i from 0 to size - 1, vectorised for the processor it runs on. kVectorPadding bytes
 * after each row of `first` and `second` are read, as many after `distances` clobbered.
 *
 * Sums must stay below 65536.
 */
void columnDistances(const std::uint8_t *first, std::size_t firstStride, const std::uint8_t *second,
                     std::size_t secondStride, std::size_t rows, std::size_t size,
                     const DistanceScale &scale, std::uint8_t *distances);

} // namespace homeward
