// SPDX-License-Identifier: GPL-3.0-or-later
#include "legend.h"

#include "symbols.h"

#include <algorithm>
#include <utility>

namespace homeward
{

namespace
{

constexpr double kTextSize = 8.0; // height of a capital, pixels
constexpr double kGap = 24.0;     // between entries, pixels

/** Bytes of UTF-8 that do not begin a character. */
bool goesOn(char byte)
{
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

} // namespace

Legend::Legend(std::vector<LegendEntry> entries, double firstRow, double otherRows)
    : m_entries(std::move(entries))
{
  double x = 0.0;
  for (const LegendEntry &entry : m_entries) {
    const double width = entry.symbolWidth + textWidth(entry.words, kTextSize);
    const bool full = x > 0.0 && x + width > (m_rows == 1 ? firstRow : otherRows);
    if (m_rows == 0 || full) {
      ++m_rows;
      x = 0.0;
    }
    m_places.emplace_back(x, kRowHeight * (m_rows - 1));
    x += width + kGap;
  }
}

void Legend::draw(Canvas &canvas, const Point &at) const
{
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    const Point place = at + m_places[i];
    m_entries[i].symbol(canvas, place);
    canvas.text(place + Point(m_entries[i].symbolWidth, 0.5 * kTextSize), m_entries[i].words,
                kTextSize, palette::kInk, Anchor::Left);
  }
}

double textWidth(const std::string &words, double size)
{
  constexpr double kWidthOfCharacter = 0.88; // of both canvases' fonts, on average
  const auto characters =
      std::count_if(words.begin(), words.end(), [](char byte) { return !goesOn(byte); });
  return kWidthOfCharacter * size * static_cast<double>(characters);
}

std::string clipped(const std::string &words, double size, double width)
{
  if (textWidth(words, size) <= width) {
    return words;
  }
  std::string kept = words;
  while (!kept.empty() && textWidth(kept + "...", size) > width) {
    while (!kept.empty() && goesOn(kept.back())) {
      kept.pop_back();
    }
    if (!kept.empty()) {
      kept.pop_back();
    }
  }
  return kept + "...";
}

std::string counted(std::size_t count, const std::string &thing)
{
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

} // namespace homeward
