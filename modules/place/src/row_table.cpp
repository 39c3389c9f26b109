// SPDX-License-Identifier: GPL-3.0-or-later
#include "row_table.h"

#include "signature_values.h"
#include "turn_correlation.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <string>

namespace homeward
{

namespace
{

RowMetric metricOf(const SignatureTraits &kind)
{
  switch (kind.distance) {
  case SignatureDistance::Jeffrey:
    return RowMetric::Jeffrey;
  case SignatureDistance::ChiSquare:
    return RowMetric::ChiSquare;
  case SignatureDistance::L1:
    return kind.bytes ? RowMetric::AbsoluteBytes : RowMetric::Absolute;
  case SignatureDistance::TurnCorrelation:
    return kind.bytes ? RowMetric::TurnCorrelationBytes : RowMetric::TurnCorrelation;
  case SignatureDistance::Hellinger:
  case SignatureDistance::Cosine:
    break;
  }
  return RowMetric::SquaredDifference;
}

/**
 * A vector of length 1 in one dimension more, so that half the squared difference of two is 1 minus
 * their cosine. All zeros become the direction of their own, at right angles to all others.
 */
std::vector<float> unitVector(std::vector<float> values)
{
  const double square = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  const double length = std::sqrt(square);
  for (float &value : values) {
    value = length > 0.0 ? static_cast<float>(value / length) : 0.0F;
  }
  values.push_back(length > 0.0 ? 0.0F : 1.0F);
  return values;
}

std::vector<float> rootsOf(std::vector<float> values)
{
  std::transform(values.begin(), values.end(), values.begin(),
                 [](float value) { return std::sqrt(value); });
  return values;
}

std::vector<float> comparedValues(const Signature &signature)
{
  switch (traits(signature.kind).distance) {
  case SignatureDistance::Jeffrey:
    return rootsOf(signature.values);
  case SignatureDistance::Hellinger:
    return unitVector(rootsOf(signature.values));
  case SignatureDistance::Cosine:
    return unitVector(signature.values);
  case SignatureDistance::TurnCorrelation:
    return traits(signature.kind).bytes ? signature.values : unitVector(signature.values);
  case SignatureDistance::ChiSquare:
  case SignatureDistance::L1:
    break;
  }
  return signature.values;
}

void requireValid(const Signature &signature)
{
  constexpr float kLargestByte = 255.0F;
  const bool bytes = traits(signature.kind).bytes;
  const bool phases = traits(signature.kind).distance == SignatureDistance::TurnCorrelation;
  if (phases && signature.values.size() % kTurnRow != 0) {
    throw LogicError("a signature " + std::string(name(signature.kind)) + " has rows of " +
                     std::to_string(kTurnRow) + " values, not " +
                     std::to_string(signature.values.size()) + " in all");
  }
  const bool signs = (phases && !bytes) || signature.kind == SignatureKind::Embedding;
  for (const float value : signature.values) {
    const bool fits = (signs || value >= 0.0F) && std::isfinite(value);
    if (!fits || (bytes && (value > kLargestByte || value != std::floor(value)))) {
      throw LogicError("a signature " + std::string(name(signature.kind)) + " cannot hold " +
                       std::to_string(value));
    }
  }
}

} // namespace

RowTable::RowTable(SignatureKind kind) : m_kind(kind), m_metric(metricOf(traits(kind))) {}

Row RowTable::prepare(const Signature &signature) const
{
  if (signature.kind != m_kind) {
    throw LogicError("index of " + std::string(name(m_kind)) + " signatures cannot take " +
                     std::string(name(signature.kind)));
  }
  if (m_rowBytes > 0 && (signature.values.size() != m_size || signature.pixels != m_pixels)) {
    throw LogicError("index of signatures " + std::string(name(m_kind)) + " with " +
                     std::to_string(m_size) + " values of " + std::to_string(m_pixels) +
                     " pixels cannot take " + std::to_string(signature.values.size()) + " of " +
                     std::to_string(signature.pixels));
  }
  requireValid(signature);
  const std::vector<float> values = comparedValues(signature);
  const std::size_t bytes = values.size() * (traits(m_kind).bytes ? 1 : sizeof(float));
  const bool centred = m_metric == RowMetric::TurnCorrelationBytes;
  const auto padding = static_cast<std::byte>(centred ? static_cast<int>(kZeroByte) : 0);
  Row row(std::max<std::size_t>(1, (bytes + kRowAlignment - 1) / kRowAlignment) * kRowAlignment,
          padding);
  if (traits(m_kind).bytes) {
    std::transform(values.begin(), values.end(), row.begin(), [](float value) {
      return static_cast<std::byte>(static_cast<std::uint8_t>(value));
    });
  }
  else {
    std::memcpy(row.data(), values.data(), bytes);
  }
  return row;
}

void RowTable::append(const Signature &signature, const Row &row)
{
  if (m_rowBytes == 0) {
    m_pixels = signature.pixels;
    m_size = signature.values.size();
    m_rowBytes = row.size();
    m_unit = dissimilarityUnit(signature);
    reserve(m_reserved);
  }
  m_bytes.insert(m_bytes.end(), row.begin(), row.end());
}

void RowTable::removeRow(std::size_t index)
{
  const auto last = m_bytes.end() - static_cast<std::ptrdiff_t>(m_rowBytes);
  std::copy(last, m_bytes.end(), m_bytes.begin() + static_cast<std::ptrdiff_t>(index * m_rowBytes));
  m_bytes.erase(last, m_bytes.end());
}

void RowTable::reserve(std::size_t count)
{
  m_reserved = count;
  m_bytes.reserve(count * m_rowBytes);
}

RowBlock RowTable::rows(std::size_t begin, std::size_t end) const
{
  return {m_bytes.data() + begin * m_rowBytes, end - begin, m_rowBytes};
}

double RowTable::dissimilarityOf(float distance) const
{
  const auto sum = static_cast<double>(distance);
  switch (traits(m_kind).distance) {
  case SignatureDistance::Jeffrey:
    return sum / std::log(10.0) / m_unit;
  case SignatureDistance::ChiSquare:
  case SignatureDistance::Cosine:
    return sum / 2.0 / m_unit;
  case SignatureDistance::Hellinger:
    return std::sqrt(sum / 2.0);
  case SignatureDistance::L1:
  case SignatureDistance::TurnCorrelation:
    break;
  }
  return sum / m_unit;
}

} // namespace homeward
