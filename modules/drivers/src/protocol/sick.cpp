// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/sick.h>

#include "field_reader.h"

#include <string>

namespace homeward
{
namespace
{

constexpr std::uint8_t kStart = 0x02;
constexpr std::size_t kLargestPayload = 812;
constexpr std::uint8_t kMeasurement = 0xB0;
constexpr unsigned kCountMask = 0x03FF;
constexpr unsigned kPartMask = 0x3800; ///< which part of an interlaced scan, and "incomplete"

/** Counts at and above (all ones) - 8 are words. */
constexpr unsigned kWords = 8;

} // namespace

std::uint16_t sickCrc(std::span<const std::uint8_t> bytes)
{
  unsigned crc = 0;
  unsigned previous = 0;
  for (const std::uint8_t byte : bytes) {
    crc = (crc & 0x8000U) != 0 ? ((crc & 0x7FFFU) << 1U) ^ 0x8005U : crc << 1U;
    crc ^= byte | previous << 8U;
    previous = byte;
  }
  return static_cast<std::uint16_t>(crc);
}

Bytes frameSick(const SickTelegram &telegram)
{
  const std::size_t length = telegram.payload.size();
  if (length > kLargestPayload) {
    throw LogicError("SICK telegram with " + std::to_string(length) + " bytes; 812 at most");
  }
  Bytes frame;
  frame.reserve(length + 6);
  for (const std::size_t byte :
       {std::size_t{kStart}, std::size_t{telegram.address}, length & 0xFFU, length >> 8U}) {
    frame.push_back(static_cast<std::uint8_t>(byte));
  }
  frame.insert(frame.end(), telegram.payload.begin(), telegram.payload.end());
  const std::uint16_t crc = sickCrc(frame);
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return frame;
}

void SickReader::push(std::span<const std::uint8_t> bytes)
{
  m_bytes.erase(m_bytes.begin(), m_bytes.begin() + static_cast<std::ptrdiff_t>(m_begin));
  m_begin = 0;
  m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
}

std::optional<SickTelegram> SickReader::next()
{
  constexpr std::size_t kHead = 4; // start, address, length
  constexpr std::size_t kOverhead = kHead + 2;
  while (m_bytes.size() >= m_begin + kOverhead) {
    const std::span<const std::uint8_t> rest = std::span(m_bytes).subspan(m_begin);
    const std::size_t length = rest[2] | static_cast<std::size_t>(rest[3]) << 8U;
    const bool address = rest[1] == kSickHost || rest[1] == kSickScanner;
    if (rest[0] != kStart || !address || length == 0 || length > kLargestPayload) {
      ++m_begin;
      continue;
    }
    if (rest.size() < length + kOverhead) {
      return std::nullopt;
    }
    const auto payload = rest.subspan(kHead, length);
    const unsigned crc = rest[kHead + length] | static_cast<unsigned>(rest[kHead + length + 1])
                                                    << 8U;
    if (crc != sickCrc(rest.first(kHead + length))) {
      ++m_begin;
      continue;
    }
    m_begin += length + kOverhead;
    return SickTelegram{rest[1], Bytes(payload.begin(), payload.end())};
  }
  return std::nullopt;
}

SickTelegram encodeSickScan(const SickScan &scan)
{
  if (scan.counts.size() > 401) {
    throw LogicError("SICK scan with " + std::to_string(scan.counts.size()) + " counts");
  }
  const unsigned unit = scan.unit == 0.001 ? 0x4000U : scan.unit == 0.1 ? 0x8000U : 0U;
  const unsigned head =
      static_cast<unsigned>(scan.counts.size()) | unit | (scan.whole ? 0U : 0x2000U);
  SickTelegram telegram{kSickScanner,
                        {kMeasurement, static_cast<std::uint8_t>(head & 0xFFU),
                         static_cast<std::uint8_t>(head >> 8U)}};
  for (const std::uint16_t count : scan.counts) {
    telegram.payload.push_back(static_cast<std::uint8_t>(count & 0xFFU));
    telegram.payload.push_back(static_cast<std::uint8_t>(count >> 8U));
  }
  telegram.payload.push_back(scan.status);
  return telegram;
}

std::optional<SickScan> parseSickScan(const SickTelegram &telegram)
{
  FieldReader reader(telegram.payload);
  if (reader.u8() != kMeasurement) {
    return std::nullopt;
  }
  const unsigned head = reader.u16();
  SickScan scan;
  scan.unit = (head & 0xC000U) == 0 ? 0.01 : (head & 0xC000U) == 0x4000U ? 0.001 : 0.1;
  scan.whole = (head & kPartMask) == 0;
  const std::size_t count = head & kCountMask;
  if (reader.left() < 2 * count + 1) {
    return std::nullopt;
  }
  scan.counts.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    scan.counts.push_back(reader.u16());
  }
  scan.status = reader.u8();
  return scan;
}

Scan sickRanges(const SickScan &scan, int flagBits, double fieldOfView, Time stamp)
{
  if (flagBits < 1 || flagBits > 3 || scan.counts.size() < 2) {
    throw LogicError("SICK scan with " + std::to_string(flagBits) + " flag bits and " +
                     std::to_string(scan.counts.size()) + " counts");
  }
  const unsigned mask = 0xFFFFU >> static_cast<unsigned>(flagBits);
  const unsigned beyond = mask - kWords;
  Scan result;
  result.stamp = stamp;
  result.angleMin = -fieldOfView / 2.0;
  result.angleStep = fieldOfView / static_cast<double>(scan.counts.size() - 1);
  result.rangeMax = static_cast<float>(beyond * scan.unit);
  result.ranges.reserve(scan.counts.size());
  for (const std::uint16_t count : scan.counts) {
    const unsigned value = count & mask;
    result.ranges.push_back(value > beyond ? kUnknownRange : static_cast<float>(value * scan.unit));
  }
  return result;
}

} // namespace homeward
