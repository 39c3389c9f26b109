// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/protocol/arcos.h>

#include "field_reader.h"
#include "field_writer.h"

namespace homeward
{
namespace
{

/** Bytes of the tail before and after the turn rate, in a robot that says it. */
constexpr std::size_t kTailBeforeTurnRate = 8;
constexpr std::uint8_t kNoTemperature = 0x81;

/** Difference of two counters modulo 2^15, the nearer way round. */
int counterStep(std::uint16_t from, std::uint16_t to)
{
  const int step = (to - from) & 0x7FFF;
  return step >= 0x4000 ? step - 0x8000 : step;
}

} // namespace

ArcosPacket encodeIdentity(const ArcosIdentity &identity)
{
  ArcosPacket packet{static_cast<std::uint8_t>(ArcosCommand::Sync2), {}};
  FieldWriter writer(packet.args);
  for (const std::string &text : {identity.name, identity.robotClass, identity.subclass}) {
    writer.text(text);
  }
  return packet;
}

std::optional<ArcosIdentity> parseIdentity(const ArcosPacket &packet)
{
  if (packet.id != static_cast<std::uint8_t>(ArcosCommand::Sync2)) {
    return std::nullopt;
  }
  FieldReader reader(packet.args);
  ArcosIdentity identity{reader.text(), reader.text(), reader.text()};
  return reader.ok() ? std::optional(std::move(identity)) : std::nullopt;
}

ArcosPacket encodeSip(const ArcosSip &sip)
{
  ArcosPacket packet{sip.moving ? kSipMoving : kSipStopped, {}};
  FieldWriter writer(packet.args);
  writer.u16(sip.x);
  writer.u16(sip.y);
  writer.i16(sip.heading);
  writer.i16(sip.leftSpeed);
  writer.i16(sip.rightSpeed);
  writer.u8(sip.battery);
  writer.u16(sip.stall);
  writer.i16(sip.control);
  writer.u16(sip.flags);
  writer.u8(sip.compass);
  writer.u8(static_cast<std::uint8_t>(sip.sonars.size()));
  for (const ArcosSonar &sonar : sip.sonars) {
    writer.u8(sonar.index);
    writer.u16(sonar.range);
  }
  if (sip.turnRate) {
    writer.zeros(3);    // gripper, analog
    writer.u16(0xFFFF); // digital in and out
    writer.u16(sip.battery);
    writer.u8(0); // charge state
    writer.i16(*sip.turnRate);
    writer.zeros(4); // faults, lateral speed
    writer.u8(kNoTemperature);
    writer.u8(0); // state of charge
  }
  return packet;
}

std::optional<ArcosSip> parseSip(const ArcosPacket &packet)
{
  if (packet.id != kSipStopped && packet.id != kSipMoving) {
    return std::nullopt;
  }
  FieldReader reader(packet.args);
  ArcosSip sip;
  sip.moving = packet.id == kSipMoving;
  sip.x = reader.u16();
  sip.y = reader.u16();
  sip.heading = reader.i16();
  sip.leftSpeed = reader.i16();
  sip.rightSpeed = reader.i16();
  sip.battery = reader.u8();
  sip.stall = reader.u16();
  sip.control = reader.i16();
  sip.flags = reader.u16();
  sip.compass = reader.u8();
  const std::size_t sonars = reader.u8();
  sip.sonars.reserve(sonars);
  for (std::size_t i = 0; i < sonars; ++i) {
    const std::uint8_t index = reader.u8();
    sip.sonars.push_back({index, reader.u16()});
  }
  if (!reader.ok()) {
    return std::nullopt;
  }
  if (reader.left() >= kTailBeforeTurnRate + 2) {
    reader.skip(kTailBeforeTurnRate);
    sip.turnRate = reader.i16();
  }
  return sip;
}

std::optional<ArcosUnits> ArcosUnits::of(const std::string &subclass)
{
  ArcosUnits units;
  if (subclass == "p3at") {
    units.distance = 0.465e-3;
    return units;
  }
  return subclass == "p3at-sh" ? std::optional(units) : std::nullopt;
}

Pose2 ArcosOdometry::update(const ArcosSip &sip)
{
  m_x += counterStep(m_last ? m_last->x : std::uint16_t{0}, sip.x);
  m_y += counterStep(m_last ? m_last->y : std::uint16_t{0}, sip.y);
  m_last = sip;
  return {static_cast<double>(m_x) * m_units.distance, static_cast<double>(m_y) * m_units.distance,
          wrapAngle(sip.heading * m_units.angle)};
}

Twist2 arcosVelocity(const ArcosSip &sip, const ArcosUnits &units)
{
  const double left = sip.leftSpeed * units.speed;
  const double right = sip.rightSpeed * units.speed;
  const double turnRate =
      sip.turnRate ? radians(*sip.turnRate / 10.0) : (right - left) / 2.0 * units.turnPerDiff;
  return {(left + right) / 2.0, turnRate};
}

} // namespace homeward
