// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace homeward
{

/**
 * Root of `value` between `low`, where it is negative, and `high`, where it is not: Newton, halving
 * where that leaves the bracket.
 * @param value, slope functions of a double
 */
template <class Value, class Slope>
double rootBetween(double low, double high, double start, Value value, Slope slope)
{
  constexpr int kIterations = 100;
  double x = start;
  for (int i = 0; i < kIterations; ++i) {
    const double y = value(x);
    (y < 0.0 ? low : high) = x;
    double next = x - y / slope(x);
    if (!(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    if (std::abs(next - x) <= 1e-15 * (std::abs(x) + 1e-300)) {
      return next;
    }
    x = next;
  }
  return x;
}

/** First root in (0, end) of a function positive at 0, looked for in steps; `end` without one. */
template <class Value> double firstRoot(double end, Value value)
{
  constexpr int kSteps = 2000;
  for (int i = 1; i <= kSteps; ++i) {
    double high = end * i / kSteps;
    if (value(high) > 0.0) {
      continue;
    }
    double low = end * (i - 1) / kSteps;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (value(middle) > 0.0 ? low : high) = middle;
    }
    return low;
  }
  return end;
}

} // namespace homeward
