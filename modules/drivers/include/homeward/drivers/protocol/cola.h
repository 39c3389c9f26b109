// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/scan.h>
#include <homeward/drivers/protocol/arcos.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/**
 * CoLa A, the telegrams in text that a SICK LMS1xx and its host exchange over Ethernet: both
 * directions, no I/O. Words are parted by blanks, numbers are hexadecimal unless they bear a sign.
 * Source: SICK, Telegram Listing Ranging Sensors (8014631).
 */
namespace homeward
{

/** The telegram in its frame: 02, text, 03. @throw LogicError when the text holds one of these */
Bytes frameCola(std::string_view text);

/** Cuts a stream of bytes into telegrams; what stands between them, and giants, are skipped. */
class ColaReader
{
public:
  /** Takes what has come in. */
  void push(std::span<const std::uint8_t> bytes);

  /** The text of the next whole telegram; nothing until more bytes come. */
  std::optional<std::string> next();

private:
  std::string m_text; ///< what has not been read yet
};

/** The distances of a telegram of measured data (LMDscandata). */
struct ColaScan
{
  std::uint32_t begun = 0;     ///< microseconds of the scanner's life when the sweep began, ...
  std::uint32_t sent = 0;      ///< ... and when it was sent
  float scale = 1.0F;          ///< millimetres per count
  float offset = 0.0F;         ///< millimetres of a count of zero
  std::int32_t startAngle = 0; ///< 1/10000 degree, counter-clockwise; 90 degrees is ahead
  std::uint16_t angleStep = 0; ///< 1/10000 degree
  std::vector<std::uint16_t> counts; ///< counter-clockwise

  bool operator==(const ColaScan &) const = default;
};

/** A telegram of the stream (sSN), with no other channels. */
std::string encodeColaScan(const ColaScan &scan);

/** Nothing when it is another telegram, one cut short, or one without distances (DIST1). */
std::optional<ColaScan> parseColaScan(std::string_view telegram);

/**
 * Ranges of a scan, in the laser's frame. Counts below 4 are words (nothing seen, dazzled,
 * implausible, filtered), which are unknown.
 * @param rangeMax metres @throw LogicError without a step
 */
Scan colaRanges(const ColaScan &scan, double rangeMax, Time stamp);

} // namespace homeward
