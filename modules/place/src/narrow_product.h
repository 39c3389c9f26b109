// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace homeward
{

/** Columns of the right-hand side of narrowProduct(). */
inline constexpr std::size_t kNarrowColumns = 32;

/**
 * product = a b, vectorised for the processor it runs on, on the calling thread. All matrices are
 * stored row by row.
 * @param a rows x inner
 * @param b inner x kNarrowColumns
 * @param product rows x kNarrowColumns
 */
void narrowProduct(const float *a, std::size_t rows, std::size_t inner, const float *b,
                   float *product);

} // namespace homeward
