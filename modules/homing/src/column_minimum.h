// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace homeward
{

/** Bytes that vector loops may read or write beyond the last element. */
inline constexpr std::size_t kVectorPadding = 256;

/**
 * minima[i] = min over r of rows[r][i] and sums[i] += minima[i], for i from 0 to size - 1: the
 * inner loop of min-warping, vectorised for the processor it runs on. Elements after `size` (see
 * kVectorPadding, in bytes) are clobbered.
 */
void addColumnMinima(const std::uint8_t *const *rows, std::size_t rowCount, std::size_t size,
                     std::uint8_t *minima, std::uint16_t *sums);

} // namespace homeward
