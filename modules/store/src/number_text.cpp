// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace homeward
{

namespace
{

constexpr int kDecimals = 6;

} // namespace

std::string exactText(double value)
{
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

std::string fixedText(double value)
{
  std::array<char, 400> buffer{}; // the largest double has 309 digits before the point
  const double shown = std::abs(value) < 0.5e-6 ? 0.0 : value;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), shown,
                                 std::chars_format::fixed, kDecimals);
  return {buffer.data(), end.ptr};
}

std::optional<double> parseNumber(std::string_view text)
{
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

} // namespace homeward
