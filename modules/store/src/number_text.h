// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace homeward
{

/** The shortest text that parseNumber() reads back exactly; never depends on the locale. */
std::string exactText(double value);

/** A number with six decimals; never depends on the locale, and zero has no sign. */
std::string fixedText(double value);

/** The number that the whole text is; nothing otherwise. */
std::optional<double> parseNumber(std::string_view text);

} // namespace homeward
