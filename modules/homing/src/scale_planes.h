// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/column_features.h>

#include <cstdint>
#include <vector>

namespace homeward
{

/**
 * Distances of every column of one view to every column of another in a stack of scale planes.
 *
 * Stored by (plane, j - i, i), i written twice over, so that a search that moves i and j together
 * reads consecutive bytes; every `step`th i stands together, for a search in such steps. Plane k
 * stands for the magnification step^(k - c) from the first view to the second, c = (planes - 1)
 * / 2.
 */
class ScalePlanes
{
public:
  /**
   * Distances between columns i of `first` and j of `second`, made with the same options.
   * @param step divides the number of columns
   */
  ScalePlanes(const ColumnFeatures &first, const ColumnFeatures &second, int step = 1);

  /** The stack with the roles swapped. */
  ScalePlanes swapped() const;

  int columns() const { return m_columns; }
  int planes() const { return m_planes; }
  int middlePlane() const { return m_planes / 2; }

  /** Distances for j - i = shift (any integer), at position(i) for i = 0 to 2 columns - 1. */
  const std::uint8_t *row(int plane, int shift) const
  {
    return &m_bytes[offset(plane, wrapColumn(shift))];
  }

  /** Where i stands in a row, from 0 to 2 columns - 1. */
  std::size_t position(int i) const
  {
    const int place = i % m_step * (2 * m_columns / m_step) + i / m_step;
    return static_cast<std::size_t>(place);
  }

  /** The value in 0 to columns - 1 for any integer. */
  int wrapColumn(int column) const
  {
    const int rest = column % m_columns;
    return rest < 0 ? rest + m_columns : rest;
  }

  /** Byte steps of a whole sum over all columns at distance 1. */
  double fullSum() const { return m_fullDistance * m_columns; }

private:
  ScalePlanes(int columns, int planes, int step, double fullDistance);

  /** Stores distances for i = 0 to columns - 1 as a row. */
  void store(int plane, int shift, const std::uint8_t *distances);

  std::size_t offset(int plane, int shift) const
  {
    return (static_cast<std::size_t>(plane) * static_cast<std::size_t>(m_columns) +
            static_cast<std::size_t>(shift)) *
           2U * static_cast<std::size_t>(m_columns);
  }

  int m_columns;
  int m_planes;
  int m_step;
  double m_fullDistance; ///< byte steps of a column distance of 1
  std::vector<std::uint8_t> m_bytes;
};

} // namespace homeward
