// SPDX-License-Identifier: GPL-3.0-or-later
#include "shift_windows.h"

#include "column_minimum.h"

#include <algorithm>

namespace homeward
{

ShiftWindows::ShiftWindows(const ScalePlanes &planes)
    : m_columns(static_cast<std::size_t>(planes.columns()))
{
  const std::size_t rowSize = 2 * m_columns;
  const std::size_t levelSize = static_cast<std::size_t>(planes.planes()) * m_columns * rowSize;
  m_bytes.reserve(kLevels * levelSize + kVectorPadding);
  m_bytes.assign(planes.row(0, 0), planes.row(0, 0) + levelSize);
  m_bytes.resize(kLevels * levelSize + kVectorPadding);
  std::uint8_t *minima = &m_bytes[levelSize];
  for (int level = 1; level < kLevels; ++level) {
    const int half = 1 << (level - 1);
    for (int plane = 0; plane < planes.planes(); ++plane) {
      const int run = (level - 1) * planes.planes() + plane;
      for (int shift = 0; shift < planes.columns(); ++shift, minima += rowSize) {
        const std::uint8_t *first = row(run, shift);
        const std::uint8_t *second = row(run, planes.wrapColumn(shift + half));
        for (std::size_t i = 0; i < rowSize; ++i) {
          minima[i] = std::min(first[i], second[i]);
        }
      }
    }
  }
}

} // namespace homeward
