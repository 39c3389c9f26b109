// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

namespace homeward
{

/**
 * Jeffrey divergence: sum of a log10(a / m) + b log10(b / m), m = (a + b) / 2, 0 log 0 = 0.
 * Like all distances here: zero on itself, symmetric, and on counts proportional to their number.
 * @param a, b counts >= 0 of the same bins
 * @throw LogicError when the sizes differ
 */
double jeffreyDivergence(std::span<const float> a, std::span<const float> b);

/** sum of (a - m)^2 / m, m = (a + b) / 2; bins empty in both add nothing. As jeffreyDivergence().
 */
double chiSquare(std::span<const float> a, std::span<const float> b);

/** sum of |a - b|. As jeffreyDivergence(). */
double sumOfAbsoluteDifferences(std::span<const float> a, std::span<const float> b);

/**
 * sqrt(sum of (sqrt(p) - sqrt(q))^2 / 2) of the histograms p = a / sum a, q = b / sum b: 0 to 1
 * whatever the counts; 0 when both are empty, 1 when one is.
 * @throw LogicError when the sizes differ
 */
double hellingerDistance(std::span<const float> a, std::span<const float> b);

/** 1 - cosine of the angle between a and b, 0 to 2; 0 when both are zero, 1 when one is. */
double cosineDistance(std::span<const float> a, std::span<const float> b);

/** Frequencies of a row in a spectrum that turnCorrelationDistance() takes: 1 to this. */
inline constexpr std::size_t kTurnFrequencies = 16;

/**
 * 1 - the largest correlation of two sets of rows of a panorama when one is turned against the
 * other, 0 to 2; 0 when both are zero, 1 when one is. Turns are tried in steps of a 128th of a
 * whole one and refined by a parabola.
 * @param a, b row by row the real parts of the frequencies 1 to kTurnFrequencies, then the
 * imaginary
 * @throw LogicError when the sizes differ or are no multiple of twice the frequencies
 */
double turnCorrelationDistance(std::span<const float> a, std::span<const float> b);

} // namespace homeward
