// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/arcos.h>

namespace homeward
{

/** Packet id of the answer to ArcosCommand::Config. */
inline constexpr std::uint8_t kArcosConfig = 0x20;

/** What a robot says of its own settings, as far as this project asks. ARIA takes its limits. */
struct ArcosConfig
{
  std::string robotClass = "Pioneer";   ///< as it calls itself
  std::string subclass = "p3at";        ///< whose units it uses
  std::string serial;                   ///< number of the robot
  std::string name;                     ///< given by its owner
  std::string firmware;                 ///< version
  std::uint16_t turnRateTop = 300;      ///< deg/s
  std::uint16_t speedTop = 1200;        ///< mm/s
  std::uint16_t turnAccelTop = 300;     ///< deg/s^2
  std::uint16_t accelTop = 2000;        ///< mm/s^2
  std::uint8_t sipCycle = 100;          ///< ms
  std::uint16_t frontSonar = 1;         ///< 1 when there is one
  std::uint8_t rearSonar = 1;           ///< likewise
  std::uint16_t watchdog = 2000;        ///< ms without a command before it stops
  std::uint16_t turnRateMax = 100;      ///< deg/s, until ArcosCommand::SetRv says otherwise
  std::uint16_t speedMax = 750;         ///< mm/s, likewise
  std::uint16_t turnAcceleration = 100; ///< deg/s^2
  std::uint16_t turnDeceleration = 100; ///< deg/s^2
  std::uint16_t acceleration = 300;     ///< mm/s^2
  std::uint16_t deceleration = 300;     ///< mm/s^2

  bool operator==(const ArcosConfig &) const = default;
};

/** The packet up to the charge threshold; newer robots append more. */
ArcosPacket encodeConfig(const ArcosConfig &config);

/** Nothing when it is another packet or one cut short. */
std::optional<ArcosConfig> parseConfig(const ArcosPacket &packet);

} // namespace homeward
