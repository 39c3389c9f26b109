// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace homeward
{

/** Appends little-endian fields to a packet; what FieldReader takes off again. */
class FieldWriter
{
public:
  explicit FieldWriter(std::vector<std::uint8_t> &bytes) : m_bytes(bytes) {}

  void u8(std::uint8_t value) { m_bytes.push_back(value); }

  void u16(std::uint16_t value)
  {
    u8(static_cast<std::uint8_t>(value & 0xFFU));
    u8(static_cast<std::uint8_t>(value >> 8U));
  }

  void i16(std::int16_t value) { u16(static_cast<std::uint16_t>(value)); }

  /** With a NUL behind. */
  void text(std::string_view value)
  {
    m_bytes.insert(m_bytes.end(), value.begin(), value.end());
    u8(0);
  }

  /** So many bytes of nought. */
  void zeros(std::size_t count) { m_bytes.resize(m_bytes.size() + count); }

private:
  std::vector<std::uint8_t> &m_bytes;
};

} // namespace homeward
