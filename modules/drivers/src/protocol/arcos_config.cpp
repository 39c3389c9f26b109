// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/protocol/arcos_config.h>

#include "field_reader.h"
#include "field_writer.h"

namespace homeward
{
namespace
{

// Bytes between the fields that are read, in the order of the packet.
constexpr std::size_t kAfterTops = 2;                  ///< PWM
constexpr std::size_t kAfterSipCycle = 4;              ///< baud rates, gripper
constexpr std::size_t kAfterRearSonar = 4;             ///< low battery, encoder counts
constexpr std::size_t kAfterWatchdog = 9;              ///< packet kind, stall, joystick
constexpr std::size_t kAfterTurnRamps = 6;             ///< gains of the turn
constexpr std::size_t kBeforeFirmware = 6 + 14;        ///< gains, bumpers to shutdown voltage
constexpr std::size_t kAfterFirmware = 4 + 1 + 10 + 2; ///< gyro, delay, lateral, charge threshold

} // namespace

ArcosPacket encodeConfig(const ArcosConfig &config)
{
  ArcosPacket packet{kArcosConfig, {}};
  FieldWriter writer(packet.args);
  writer.text(config.robotClass);
  writer.text(config.subclass);
  writer.text(config.serial);
  writer.u8(0); // two motors
  writer.u16(config.turnRateTop);
  writer.u16(config.speedTop);
  writer.u16(config.turnAccelTop);
  writer.u16(config.accelTop);
  writer.zeros(kAfterTops);
  writer.text(config.name);
  writer.u8(config.sipCycle);
  writer.zeros(kAfterSipCycle);
  writer.u16(config.frontSonar);
  writer.u8(config.rearSonar);
  writer.zeros(kAfterRearSonar);
  writer.u16(config.watchdog);
  writer.zeros(kAfterWatchdog);
  writer.u16(config.turnRateMax);
  writer.u16(config.speedMax);
  writer.u16(config.turnAcceleration);
  writer.u16(config.turnDeceleration);
  writer.zeros(kAfterTurnRamps);
  writer.u16(config.acceleration);
  writer.u16(config.deceleration);
  writer.zeros(kBeforeFirmware);
  writer.text(config.firmware);
  writer.zeros(kAfterFirmware);
  return packet;
}

std::optional<ArcosConfig> parseConfig(const ArcosPacket &packet)
{
  if (packet.id != kArcosConfig) {
    return std::nullopt;
  }
  FieldReader reader(packet.args);
  ArcosConfig config;
  config.robotClass = reader.text();
  config.subclass = reader.text();
  config.serial = reader.text();
  reader.skip(1);
  config.turnRateTop = reader.u16();
  config.speedTop = reader.u16();
  config.turnAccelTop = reader.u16();
  config.accelTop = reader.u16();
  reader.skip(kAfterTops);
  config.name = reader.text();
  config.sipCycle = reader.u8();
  reader.skip(kAfterSipCycle);
  config.frontSonar = reader.u16();
  config.rearSonar = reader.u8();
  reader.skip(kAfterRearSonar);
  config.watchdog = reader.u16();
  reader.skip(kAfterWatchdog);
  config.turnRateMax = reader.u16();
  config.speedMax = reader.u16();
  config.turnAcceleration = reader.u16();
  config.turnDeceleration = reader.u16();
  reader.skip(kAfterTurnRamps);
  config.acceleration = reader.u16();
  config.deceleration = reader.u16();
  reader.skip(kBeforeFirmware);
  config.firmware = reader.text();
  reader.skip(kAfterFirmware);
  return reader.ok() ? std::optional(std::move(config)) : std::nullopt;
}

} // namespace homeward
