// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/scan.h>
#include <homeward/drivers/protocol/arcos.h>

#include <cstdint>
#include <optional>
#include <span>

/** The telegrams that a SICK LMS-2xx and its host exchange: both directions, no I/O. */
namespace homeward
{

inline constexpr std::uint8_t kSickHost = 0x00;    ///< address in the host's telegrams
inline constexpr std::uint8_t kSickScanner = 0x80; ///< address in the scanner's
inline constexpr std::uint8_t kSickAck = 0x06;     ///< comes before an answer
/** The byte that refuses a telegram. */
inline constexpr std::uint8_t kSickNak = 0x15;

/** One telegram without its frame; the payload is command and data (and in answers a status). */
struct SickTelegram
{
  std::uint8_t address = kSickHost; ///< of whom it is for
  Bytes payload;                    ///< command or answer and what belongs to it

  bool operator==(const SickTelegram &) const = default;
};

/** SICK's own CRC, polynomial 0x8005, over 02 up to the end of the payload. */
std::uint16_t sickCrc(std::span<const std::uint8_t> bytes);

/** The telegram in its frame: 02, address, length, payload, CRC. @throw LogicError above 812 bytes
 */
Bytes frameSick(const SickTelegram &telegram);

/** Cuts a stream of bytes into telegrams; ACK, NAK, noise and broken telegrams are skipped. */
class SickReader
{
public:
  /** Takes what has come in. */
  void push(std::span<const std::uint8_t> bytes);

  /** The next whole telegram; nothing until more bytes come. */
  std::optional<SickTelegram> next();

private:
  Bytes m_bytes;
  std::size_t m_begin = 0; ///< of what has not been read yet
};

/** A measurement telegram (B0). */
struct SickScan
{
  double unit = 0.0;                 ///< metres per count: 0.01, 0.001 or 0.1
  bool whole = true;                 ///< not one part of an interlaced scan
  std::vector<std::uint16_t> counts; ///< from the right, counter-clockwise, flags still in
  std::uint8_t status = 0;           ///< as the telegram ends

  bool operator==(const SickScan &) const = default;
};

/** The telegram that says it. */
SickTelegram encodeSickScan(const SickScan &scan);

/** Nothing when it is another telegram or one cut short. */
std::optional<SickScan> parseSickScan(const SickTelegram &telegram);

/**
 * Ranges of a scan, in the laser's frame. The highest nine counts are words, not ranges: the lowest
 * of them says "beyond the range", the others "nothing measured", which is unknown.
 * @param flagBits how many of the upper bits are flags: 1, 2 or 3, by the measuring mode
 * @param fieldOfView radians, centred on forward
 * @throw LogicError with other flagBits or fewer than two counts
 */
Scan sickRanges(const SickScan &scan, int flagBits, double fieldOfView, Time stamp);

} // namespace homeward
