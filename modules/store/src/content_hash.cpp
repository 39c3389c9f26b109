// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/store/content_hash.h>

namespace homeward
{

std::uint64_t contentHash(std::span<const unsigned char> bytes)
{
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const unsigned char byte : bytes) {
    hash = (hash ^ byte) * 0x100000001b3U;
  }
  return hash;
}

std::string contentHashText(std::string_view text)
{
  return hashText(contentHash({reinterpret_cast<const unsigned char *>(text.data()), text.size()}));
}

std::string hashText(std::uint64_t hash)
{
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < text.size(); ++i) {
    text[text.size() - 1 - i] = kDigits[(hash >> (4 * i)) & 0xfU];
  }
  return text;
}

} // namespace homeward
