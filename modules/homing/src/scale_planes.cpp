// SPDX-License-Identifier: GPL-3.0-or-later
#include "scale_planes.h"

#include "column_minimum.h"

#include <algorithm>

namespace homeward
{

namespace
{

/** Largest byte of a distance; so many of them still add up in 16 bits. */
int largestByte(int columns)
{
  return std::min(255, 65535 / columns);
}

/** Byte steps of a column distance of 1; leaves head-room for rounding in the columns. */
int distanceRange(int columns)
{
  return largestByte(columns) - 15;
}

int sumOfAbsoluteDifferences(const std::uint8_t *__restrict a, const std::uint8_t *__restrict b,
                             std::size_t size)
{
  int sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const int difference = static_cast<int>(a[i]) - static_cast<int>(b[i]);
    sum += difference < 0 ? -difference : difference;
  }
  return sum;
}

} // namespace

ScalePlanes::ScalePlanes(int columns, int planes, double fullDistance)
    : m_columns(columns), m_planes(planes), m_fullDistance(fullDistance),
      m_bytes(static_cast<std::size_t>(planes) * static_cast<std::size_t>(columns) * 2U *
                  static_cast<std::size_t>(columns) +
              kVectorPadding)
{}

ScalePlanes::ScalePlanes(const ColumnFeatures &first, const ColumnFeatures &second)
    : ScalePlanes(first.options.columns, 2 * first.options.magnifications - 1,
                  distanceRange(first.options.columns))
{
  const auto rows = static_cast<std::size_t>(first.options.rows);
  const auto columns = static_cast<std::size_t>(m_columns);
  // Two columns of unit norm differ by at most twice their norm.
  const int largest = 2 * kColumnUnit * first.options.rows;
  const int most = largestByte(m_columns);
  const int factor = (distanceRange(m_columns) << 16) / largest;
  for (int plane = 0; plane < m_planes; ++plane) {
    const int steps = plane - middlePlane();
    const std::uint8_t *from = first.versions[static_cast<std::size_t>(std::max(0, steps))].data();
    const std::uint8_t *to = second.versions[static_cast<std::size_t>(std::max(0, -steps))].data();
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t j = 0; j < columns; ++j) {
        const int sum = sumOfAbsoluteDifferences(from + i * rows, to + j * rows, rows);
        const auto byte = static_cast<std::uint8_t>(std::min(most, (sum * factor) >> 16));
        const std::size_t shift = j >= i ? j - i : j + columns - i;
        const std::size_t at = offset(plane, static_cast<int>(shift)) + i;
        m_bytes[at] = byte;
        m_bytes[at + columns] = byte;
      }
    }
  }
}

ScalePlanes ScalePlanes::swapped() const
{
  ScalePlanes result(m_columns, m_planes, m_fullDistance);
  for (int plane = 0; plane < m_planes; ++plane) {
    for (int shift = 0; shift < m_columns; ++shift) {
      // Column j = i + shift of the second view becomes the leading index.
      const std::uint8_t *source = row(plane, shift) + wrapColumn(-shift);
      std::uint8_t *target =
          &result.m_bytes[result.offset(m_planes - 1 - plane, wrapColumn(-shift))];
      std::copy_n(source, m_columns, target);
      std::copy_n(source, m_columns, target + m_columns);
    }
  }
  return result;
}

} // namespace homeward
