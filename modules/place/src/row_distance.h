// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace homeward
{

/** What is summed over the elements of two rows. */
enum class RowMetric
{
  Jeffrey,              ///< rows of roots of counts: a ln(2 a / (a + b)) + b ln(2 b / (a + b))
  ChiSquare,            ///< (a - b)^2 / (a + b), 0 where both are
  Absolute,             ///< |a - b|
  SquaredDifference,    ///< (a - b)^2
  TurnCorrelation,      ///< 1 - the largest correlation over all turns, of unit vectors; no sum
  TurnCorrelationBytes, ///< the same of rows of std::uint8_t of any length, 128 for zero
  AbsoluteBytes         ///< |a - b| of rows of std::uint8_t, exact; the others are rows of float
};

/** Rows are as long as a multiple of this, and filled up with what stands for zero. */
inline constexpr std::size_t kRowAlignment = 64;

/** Rows stored one after the other. */
struct RowBlock
{
  const std::byte *rows = nullptr; ///< aligned to kRowAlignment
  std::size_t count = 0;
  std::size_t rowBytes = 0; ///< of one row, a multiple of kRowAlignment
};

/**
 * Compares one row with many, vectorised for the processor it runs on.
 *
 * Jeffrey: with s = a + b, d = a - b and q = 2 sqrt(a b) / s a bin adds d^2 / s h(q), all terms
 * positive, so that nothing cancels between like histograms; h is a quotient of polynomials, good
 * to 3.1e-5, and so is the quotient to 6.2e-5. The result for a row does not depend on how the rows
 * are cut into blocks.
 * @param query a row of the same length
 * @param distances one a row
 */
void rowDistances(RowMetric metric, const std::byte *query, const RowBlock &block,
                  float *distances);

/** The same in plain C++ and double precision, the logarithms as they are written above. */
void rowDistancesScalar(RowMetric metric, const std::byte *query, const RowBlock &block,
                        float *distances);

} // namespace homeward
