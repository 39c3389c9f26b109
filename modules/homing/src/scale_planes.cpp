// SPDX-License-Identifier: GPL-3.0-or-later
#include "scale_planes.h"

#include "column_distances.h"
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

/** Element r of column i at [r * stride + i], the columns `times` over, with room to read beyond.
 */
std::vector<std::uint8_t> transposed(const std::vector<std::uint8_t> &version, std::size_t columns,
                                     std::size_t rows, std::size_t times)
{
  const std::size_t stride = times * columns;
  std::vector<std::uint8_t> result(rows * stride + kVectorPadding);
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t copy = 0; copy < times; ++copy) {
        result[r * stride + copy * columns + i] = version[i * rows + r];
      }
    }
  }
  return result;
}

} // namespace

ScalePlanes::ScalePlanes(int columns, int planes, int step, double fullDistance)
    : m_columns(columns), m_planes(planes), m_step(step), m_fullDistance(fullDistance),
      m_bytes(static_cast<std::size_t>(planes) * static_cast<std::size_t>(columns) * 2U *
                  static_cast<std::size_t>(columns) +
              kVectorPadding)
{}

ScalePlanes::ScalePlanes(const ColumnFeatures &first, const ColumnFeatures &second, int step)
    : ScalePlanes(first.options.columns, 2 * first.options.magnifications - 1, step,
                  distanceRange(first.options.columns))
{
  const auto rows = static_cast<std::size_t>(first.options.rows);
  const auto columns = static_cast<std::size_t>(m_columns);
  // Two columns of unit norm differ by at most twice their norm.
  const int largest = 2 * kColumnUnit * first.options.rows;
  const DistanceScale scale{static_cast<std::uint16_t>((distanceRange(m_columns) << 16) / largest),
                            static_cast<std::uint16_t>(largestByte(m_columns))};
  std::vector<std::vector<std::uint8_t>> from;
  std::vector<std::vector<std::uint8_t>> to;
  for (int m = 0; m < first.options.magnifications; ++m) {
    from.push_back(transposed(first.versions[static_cast<std::size_t>(m)], columns, rows, 1));
    to.push_back(transposed(second.versions[static_cast<std::size_t>(m)], columns, rows, 2));
  }
  std::vector<std::uint8_t> distances(columns + kVectorPadding);
  for (int plane = 0; plane < m_planes; ++plane) {
    const int steps = plane - middlePlane();
    const std::uint8_t *a = from[static_cast<std::size_t>(std::max(0, steps))].data();
    const std::uint8_t *b = to[static_cast<std::size_t>(std::max(0, -steps))].data();
    for (int shift = 0; shift < m_columns; ++shift) {
      columnDistances(a, columns, b + shift, 2 * columns, rows, columns, scale, distances.data());
      store(plane, shift, distances.data());
    }
  }
}

void ScalePlanes::store(int plane, int shift, const std::uint8_t *distances)
{
  std::uint8_t *part = &m_bytes[offset(plane, shift)];
  const auto step = static_cast<std::size_t>(m_step);
  const std::size_t size = static_cast<std::size_t>(m_columns) / step;
  for (std::size_t phase = 0; phase < step; ++phase, part += 2 * size) {
    for (std::size_t k = 0; k < size; ++k) {
      part[k] = distances[phase + k * step];
    }
    std::copy_n(part, size, part + size);
  }
}

ScalePlanes ScalePlanes::swapped() const
{
  ScalePlanes result(m_columns, m_planes, m_step, m_fullDistance);
  const auto columns = static_cast<std::size_t>(m_columns);
  const auto step = static_cast<std::size_t>(m_step);
  const std::size_t size = columns / step;
  std::vector<std::uint8_t> distances(2 * columns);
  for (int plane = 0; plane < m_planes; ++plane) {
    for (int shift = 0; shift < m_columns; ++shift) {
      // Column j = i + shift of the second view becomes the leading index.
      const std::uint8_t *part = row(plane, shift);
      for (std::size_t phase = 0; phase < step; ++phase, part += 2 * size) {
        for (std::size_t k = 0; k < size; ++k) {
          distances[phase + k * step] = part[k];
        }
      }
      std::copy_n(distances.begin(), columns, distances.begin() + m_columns);
      const int first = wrapColumn(-shift);
      result.store(m_planes - 1 - plane, first, &distances[static_cast<std::size_t>(first)]);
    }
  }
  return result;
}

} // namespace homeward
