// SPDX-License-Identifier: GPL-3.0-or-later
#include "row_distance.h"

#include "signature_values.h"
#include "turn_correlation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace homeward
{

namespace
{

double jeffreyTerm(double rootA, double rootB)
{
  const double a = rootA * rootA;
  const double b = rootB * rootB;
  const double middle = (a + b) / 2.0;
  return (a > 0.0 ? a * std::log(a / middle) : 0.0) + (b > 0.0 ? b * std::log(b / middle) : 0.0);
}

double chiSquareTerm(double a, double b)
{
  return a + b > 0.0 ? (a - b) * (a - b) / (a + b) : 0.0;
}

template <class Element, class Term>
void sumRows(const std::byte *query, const RowBlock &block, float *distances, Term term)
{
  const auto *b = reinterpret_cast<const Element *>(query);
  const auto *row = reinterpret_cast<const Element *>(block.rows);
  const std::size_t size = block.rowBytes / sizeof(Element);
  for (std::size_t r = 0; r < block.count; ++r, row += size) {
    double sum = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      sum += term(static_cast<double>(row[i]), static_cast<double>(b[i]));
    }
    distances[r] = static_cast<float>(sum);
  }
}

/** Rows of spectra with one element more that only rows without a spectrum have. */
void correlateRows(const std::byte *query, const RowBlock &block, float *distances)
{
  const std::size_t size = block.rowBytes / sizeof(float);
  const std::size_t spectra = size / kTurnRow * kTurnRow;
  const std::span b(reinterpret_cast<const float *>(query), size);
  for (std::size_t r = 0; r < block.count; ++r) {
    const std::span a(reinterpret_cast<const float *>(block.rows) + r * size, size);
    std::array<double, kTurns> byTurn = correlationsByTurn(a.first(spectra), b.first(spectra));
    byTurn[0] += spectra < size ? static_cast<double>(a[spectra]) * b[spectra] : 0.0;
    distances[r] = static_cast<float>(std::max(0.0, 1.0 - peakOf(byTurn)));
  }
}

std::vector<float> spectraOfBytes(const std::byte *row, std::size_t size)
{
  std::vector<float> spectra(size);
  std::transform(row, row + size, spectra.begin(), [](std::byte value) {
    return static_cast<float>(std::to_integer<int>(value)) - kZeroByte;
  });
  return spectra;
}

void correlateByteRows(const std::byte *query, const RowBlock &block, float *distances)
{
  const std::vector<float> b = spectraOfBytes(query, block.rowBytes);
  for (std::size_t r = 0; r < block.count; ++r) {
    const std::vector<float> a = spectraOfBytes(block.rows + r * block.rowBytes, block.rowBytes);
    distances[r] = static_cast<float>(turnCorrelationDistance(a, b));
  }
}

} // namespace

void rowDistancesScalar(RowMetric metric, const std::byte *query, const RowBlock &block,
                        float *distances)
{
  const auto absolute = [](double a, double b) { return std::abs(a - b); };
  switch (metric) {
  case RowMetric::Jeffrey:
    return sumRows<float>(query, block, distances, jeffreyTerm);
  case RowMetric::ChiSquare:
    return sumRows<float>(query, block, distances, chiSquareTerm);
  case RowMetric::Absolute:
    return sumRows<float>(query, block, distances, absolute);
  case RowMetric::SquaredDifference:
    return sumRows<float>(query, block, distances,
                          [](double a, double b) { return (a - b) * (a - b); });
  case RowMetric::TurnCorrelation:
    return correlateRows(query, block, distances);
  case RowMetric::TurnCorrelationBytes:
    return correlateByteRows(query, block, distances);
  case RowMetric::AbsoluteBytes:
    return sumRows<std::uint8_t>(query, block, distances, absolute);
  }
}

} // namespace homeward
