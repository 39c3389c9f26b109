// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "canvas.h"

#include <functional>

namespace homeward
{

/** A symbol and what it means. */
struct LegendEntry
{
  double symbolWidth = 0.0; ///< pixels, with the gap before the words
  std::string words;
  /** Draws it. @param at middle of its left side */
  std::function<void(Canvas &canvas, const Point &at)> symbol;
};

/** Entries side by side, in as many rows as they need. */
class Legend
{
public:
  static constexpr double kRowHeight = 26.0; ///< pixels

  /** @param firstRow, otherRows room for each, pixels; an entry wider than a row has one alone */
  Legend(std::vector<LegendEntry> entries, double firstRow, double otherRows);

  /** Of all rows, pixels. */
  double height() const { return kRowHeight * m_rows; }

  /** @param at middle of the left side of the first row */
  void draw(Canvas &canvas, const Point &at) const;

private:
  std::vector<LegendEntry> m_entries;
  std::vector<Point> m_places; ///< of each entry, from the middle of the first row's left side
  int m_rows = 0;
};

/** About as wide as the words are drawn, rather more, pixels. @param size height of a capital */
double textWidth(const std::string &words, double size);

/** The words, their end replaced by dots where they are wider than `width` pixels. */
std::string clipped(const std::string &words, double size, double width);

/** "1 place", "2 places". */
std::string counted(std::size_t count, const std::string &thing);

} // namespace homeward
