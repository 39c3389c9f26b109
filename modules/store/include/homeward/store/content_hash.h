// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace homeward
{

/** FNV-1a, 64 bits: tells whether bytes changed by accident; no protection against malice. */
std::uint64_t contentHash(std::span<const unsigned char> bytes);

/** contentHash() of a text, as 16 hexadecimal digits; a camera file's hash, for example. */
std::string contentHashText(std::string_view text);

/** A hash as 16 hexadecimal digits. */
std::string hashText(std::uint64_t hash);

} // namespace homeward
