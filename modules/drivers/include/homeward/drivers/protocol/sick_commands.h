// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/** First bytes of the payloads that a host and a LMS-2xx exchange, and places in them. */
namespace homeward::sick
{

// What the host asks, and the first byte of the answer.
inline constexpr std::uint8_t kReset = 0x10;           ///< restart
inline constexpr std::uint8_t kResetAnswer = 0x91;     ///< to kReset
inline constexpr std::uint8_t kPowerOn = 0x90;         ///< sent by itself after a restart
inline constexpr std::uint8_t kMode = 0x20;            ///< change the mode of operation
inline constexpr std::uint8_t kModeAnswer = 0xA0;      ///< to kMode
inline constexpr std::uint8_t kStatus = 0x31;          ///< ask for the state
inline constexpr std::uint8_t kStatusAnswer = 0xB1;    ///< to kStatus
inline constexpr std::uint8_t kType = 0x3A;            ///< ask for the type
inline constexpr std::uint8_t kTypeAnswer = 0xBA;      ///< to kType
inline constexpr std::uint8_t kVariant = 0x3B;         ///< change angle and resolution
inline constexpr std::uint8_t kVariantAnswer = 0xBB;   ///< to kVariant
inline constexpr std::uint8_t kGetConfig = 0x74;       ///< ask for the configuration
inline constexpr std::uint8_t kGetConfigAnswer = 0xF4; ///< to kGetConfig
inline constexpr std::uint8_t kSetConfig = 0x77;       ///< change the configuration
inline constexpr std::uint8_t kSetConfigAnswer = 0xF7; ///< to kSetConfig

// Second byte of kMode.
inline constexpr std::uint8_t kInstallation = 0x00; ///< the password follows
inline constexpr std::uint8_t kContinuous = 0x24;   ///< mode: sends every scan
inline constexpr std::uint8_t kOnRequest = 0x25;    ///< mode: sends a scan when asked
inline constexpr std::uint8_t kBaud38400 = 0x40;    ///< mode: 38400 baud
inline constexpr std::uint8_t kBaud19200 = 0x41;    ///< mode: 19200 baud
inline constexpr std::uint8_t kBaud9600 = 0x42;     ///< mode: 9600 baud

inline constexpr char kPassword[] = "SICK_LMS"; ///< of the installation mode

// Places in the block of the configuration, and values there.
inline constexpr std::size_t kMeasuringModeAt = 5;     ///< place in the configuration
inline constexpr std::size_t kUnitAt = 6;              ///< place in the configuration
inline constexpr std::uint8_t kThirtyTwoMetres = 0x06; ///< one flag bit: field A
inline constexpr std::uint8_t kMillimetres = 0x01;     ///< of the unit

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
