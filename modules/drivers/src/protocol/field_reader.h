// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace homeward
{

/** Takes little-endian fields off the front of a packet and remembers whether it was too short. */
class FieldReader
{
public:
  explicit FieldReader(std::span<const std::uint8_t> bytes) : m_bytes(bytes) {}

  /** True while every field asked for was there. */
  bool ok() const { return m_ok; }
  std::size_t left() const { return m_bytes.size(); }

  std::uint8_t u8()
  {
    if (m_bytes.empty()) {
      m_ok = false;
      return 0;
    }
    const std::uint8_t value = m_bytes.front();
    m_bytes = m_bytes.subspan(1);
    return value;
  }

  std::uint16_t u16()
  {
    const unsigned low = u8();
    return static_cast<std::uint16_t>(low | static_cast<unsigned>(u8()) << 8U);
  }

  std::int16_t i16() { return static_cast<std::int16_t>(u16()); }

  /** Up to and without the NUL. */
  std::string text()
  {
    std::string result;
    while (const std::uint8_t letter = u8()) {
      result.push_back(static_cast<char>(letter));
    }
    return result;
  }

  void skip(std::size_t count)
  {
    m_ok = m_ok && count <= m_bytes.size();
    m_bytes = m_bytes.subspan(count <= m_bytes.size() ? count : m_bytes.size());
  }

private:
  std::span<const std::uint8_t> m_bytes;
  bool m_ok = true;
};

} // namespace homeward
