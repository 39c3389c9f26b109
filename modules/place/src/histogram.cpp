// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/histogram.h>

#include "turn_correlation.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace homeward
{

namespace
{

void requireSameSize(std::span<const float> a, std::span<const float> b)
{
  if (a.size() != b.size()) {
    throw LogicError("histograms of " + std::to_string(a.size()) + " and " +
                     std::to_string(b.size()) + " bins cannot be compared");
  }
}

} // namespace

double jeffreyDivergence(std::span<const float> a, std::span<const float> b)
{
  requireSameSize(a, b);
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double middle = (static_cast<double>(a[k]) + b[k]) / 2.0;
    sum += a[k] > 0.0F ? a[k] * std::log10(a[k] / middle) : 0.0;
    sum += b[k] > 0.0F ? b[k] * std::log10(b[k] / middle) : 0.0;
  }
  return std::max(0.0, sum);
}

double chiSquare(std::span<const float> a, std::span<const float> b)
{
  requireSameSize(a, b);
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double middle = (static_cast<double>(a[k]) + b[k]) / 2.0;
    const double difference = a[k] - middle;
    sum += middle > 0.0 ? difference * difference / middle : 0.0;
  }
  return sum;
}

double sumOfAbsoluteDifferences(std::span<const float> a, std::span<const float> b)
{
  requireSameSize(a, b);
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum += std::abs(static_cast<double>(a[k]) - b[k]);
  }
  return sum;
}

double hellingerDistance(std::span<const float> a, std::span<const float> b)
{
  requireSameSize(a, b);
  const double sumA = std::accumulate(a.begin(), a.end(), 0.0);
  const double sumB = std::accumulate(b.begin(), b.end(), 0.0);
  if (sumA == 0.0 || sumB == 0.0) {
    return sumA == sumB ? 0.0 : 1.0;
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double difference = std::sqrt(a[k] / sumA) - std::sqrt(b[k] / sumB);
    sum += difference * difference;
  }
  return std::sqrt(sum / 2.0);
}

double cosineDistance(std::span<const float> a, std::span<const float> b)
{
  requireSameSize(a, b);
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ab += static_cast<double>(a[k]) * b[k];
    aa += static_cast<double>(a[k]) * a[k];
    bb += static_cast<double>(b[k]) * b[k];
  }
  if (aa == 0.0 || bb == 0.0) {
    return aa == bb ? 0.0 : 1.0;
  }
  return std::max(0.0, 1.0 - ab / std::sqrt(aa * bb));
}

double turnCorrelationDistance(std::span<const float> a, std::span<const float> b)
{
  requireSameSize(a, b);
  if (a.size() % kTurnRow != 0) {
    throw LogicError("spectra of " + std::to_string(a.size()) + " values are no rows of " +
                     std::to_string(kTurnRow));
  }
  const double aa = std::inner_product(a.begin(), a.end(), a.begin(), 0.0);
  const double bb = std::inner_product(b.begin(), b.end(), b.begin(), 0.0);
  if (aa == 0.0 || bb == 0.0) {
    return aa == bb ? 0.0 : 1.0;
  }
  return std::max(0.0, 1.0 - peakOf(correlationsByTurn(a, b)) / std::sqrt(aa * bb));
}

} // namespace homeward
