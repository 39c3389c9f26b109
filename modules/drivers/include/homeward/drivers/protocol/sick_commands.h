// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/** First bytes of the payloads that a host and a LMS-2xx exchange, and places in them. */
namespace homeward::sick
{

// What the host asks, and the first byte of the answer.
inline constexpr std::uint8_t kReset = 0x10;
inline constexpr std::uint8_t kResetAnswer = 0x91;
inline constexpr std::uint8_t kPowerOn = 0x90;
inline constexpr std::uint8_t kMode = 0x20;
inline constexpr std::uint8_t kModeAnswer = 0xA0;
inline constexpr std::uint8_t kStatus = 0x31;
inline constexpr std::uint8_t kStatusAnswer = 0xB1;
inline constexpr std::uint8_t kType = 0x3A;
inline constexpr std::uint8_t kTypeAnswer = 0xBA;
inline constexpr std::uint8_t kVariant = 0x3B;
inline constexpr std::uint8_t kVariantAnswer = 0xBB;
inline constexpr std::uint8_t kGetConfig = 0x74;
inline constexpr std::uint8_t kGetConfigAnswer = 0xF4;
inline constexpr std::uint8_t kSetConfig = 0x77;
inline constexpr std::uint8_t kSetConfigAnswer = 0xF7;

// Second byte of kMode.
inline constexpr std::uint8_t kInstallation = 0x00; ///< the password follows
inline constexpr std::uint8_t kContinuous = 0x24;
inline constexpr std::uint8_t kOnRequest = 0x25;
inline constexpr std::uint8_t kBaud38400 = 0x40;
inline constexpr std::uint8_t kBaud19200 = 0x41;
inline constexpr std::uint8_t kBaud9600 = 0x42;

inline constexpr char kPassword[] = "SICK_LMS";

// Places in the block of the configuration, and values there.
inline constexpr std::size_t kMeasuringModeAt = 5;
inline constexpr std::size_t kUnitAt = 6;
inline constexpr std::uint8_t kThirtyTwoMetres = 0x06; ///< one flag bit: field A
inline constexpr std::uint8_t kMillimetres = 0x01;

/** How many upper bits of a count are flags in a measuring mode. */
constexpr int flagBits(std::uint8_t measuringMode)
{
  switch (measuringMode) {
  case 0x00:
  case 0x01:
  case 0x02:
    return 3;
  case 0x03:
  case 0x04:
    return 2;
  case 0x0F:
    return 0;
  default:
    return 1;
  }
}

} // namespace homeward::sick
