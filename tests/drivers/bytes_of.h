// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/arcos.h>

#include <string>
#include <string_view>

namespace homeward
{

/** The bytes of a hexadecimal text; blanks are skipped. */
inline Bytes bytesOf(std::string_view hex)
{
  std::string digits;
  for (const char letter : hex) {
    if (letter != ' ') {
      digits.push_back(letter);
    }
  }
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

} // namespace homeward
