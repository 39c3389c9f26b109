// SPDX-License-Identifier: GPL-3.0-or-later
#include "arcos_server.h"

#include "scan_samples.h"

#include <homeward/core/error.h>
#include <homeward/drivers/protocol/arcos_laser.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward
{
namespace
{

constexpr std::uint16_t kNoEcho = 5000;   ///< mm
constexpr std::uint8_t kBattery = 130;    ///< 0.1 V
constexpr unsigned kFrontBumper = 0x0800; ///< the middle one of five
constexpr unsigned kRearBumper = 0x0008;  ///< likewise
constexpr RangeWords kLaserWords{0, 32000};

template <class Whole> Whole whole(double value)
{
  return static_cast<Whole>(std::llround(value));
}

/** Of a counter that wraps. */
std::uint16_t counter(double value)
{
  return static_cast<std::uint16_t>(std::llround(value) & 0xFFFF);
}

/** One step from a speed towards another; slowing down and turning round brake first. */
double ramp(double now, double wanted, double acceleration, double deceleration, double seconds)
{
  const bool brakes = now * (wanted - now) < 0.0;
  const double most = (brakes ? deceleration : acceleration) * seconds;
  const double next = now + std::clamp(wanted - now, -most, most);
  return brakes && now * next < 0.0 ? 0.0 : next;
}

/** Signed, little endian, four bytes. */
std::int32_t wide(const Bytes &args, std::size_t at)
{
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = value << 8U | args[at + i];
  }
  return static_cast<std::int32_t>(value);
}

ArcosUnits unitsOf(const std::string &subclass)
{
  if (const auto units = ArcosUnits::of(subclass)) {
    return *units;
  }
  throw ConfigError("robot subclass '" + subclass + "' is unknown; p3at or p3at-sh");
}

} // namespace

ArcosServer::ArcosServer(const ArcosServerOptions &options)
    : m_options(options), m_units(unitsOf(options.subclass)), m_limits(options.limits)
{}

void ArcosServer::receive(std::span<const std::uint8_t> bytes, Time now)
{
  m_reader.push(bytes, now);
  while (const std::optional<ArcosPacket> packet = m_reader.next()) {
    if (m_phase == Phase::Open) {
      obey(*packet, now);
    }
    else {
      shakeHands(*packet);
      m_lastCommand = now;
      m_nextSip = now + m_options.cycle;
    }
  }
}

void ArcosServer::shakeHands(const ArcosPacket &packet)
{
  switch (static_cast<ArcosCommand>(packet.id)) {
  case ArcosCommand::Sync0:
    m_phase = Phase::Sync;
    send(packet);
    break;
  case ArcosCommand::Sync1: // OPEN has the same number
    if (m_phase == Phase::Ready) {
      m_phase = Phase::Open;
    }
    else if (packet.args.empty()) {
      send(packet);
    }
    break;
  case ArcosCommand::Sync2: // CLOSE too, which has an argument
    if (packet.args.empty()) {
      m_phase = Phase::Ready;
      send(encodeIdentity({m_options.name, "Pioneer", m_options.subclass}));
    }
    break;
  default:
    break;
  }
}

void ArcosServer::obey(const ArcosPacket &packet, Time now)
{
  m_lastCommand = now;
  const int argument = arcosArgument(packet).value_or(0);
  const auto command = static_cast<ArcosCommand>(packet.id);
  switch (command) {
  case ArcosCommand::Close:
    hangUp();
    break;
  case ArcosCommand::Enable:
    m_motors = argument != 0 && !m_switches.emergencyStop && !m_switches.motorsOff;
    stopWanting();
    break;
  case ArcosCommand::SetO:
    m_resetOdometry = true;
    break;
  case ArcosCommand::Config:
    send(encodeConfig(config()));
    break;
  case ArcosCommand::Sonar:
    m_sonar = argument != 0;
    break;
  case ArcosCommand::Stop:
    stopWanting();
    break;
  case ArcosCommand::EStop:
    stopWanting();
    m_ramped = {};
    break;
  case ArcosCommand::Vel2:
    if (packet.args.size() >= 3) {
      const double right = 0.02 * static_cast<std::int8_t>(packet.args[1]);
      const double left = 0.02 * static_cast<std::int8_t>(packet.args[2]);
      m_wanted = {(right + left) / 2.0, (right - left) / 2.0 * m_units.turnPerDiff};
      m_driving = true;
    }
    break;
  case ArcosCommand::SimSetPose:
    setPose(packet.args);
    break;
  default:
    if (arcosArgument(packet)) {
      setMotion(command, argument);
      setLaser(command, argument);
    }
    break;
  }
}

void ArcosServer::setMotion(ArcosCommand command, int argument)
{
  const Limits &most = m_options.limits;
  const double metres = std::abs(argument) / 1000.0;
  const double angle = radians(std::abs(argument));
  switch (command) {
  case ArcosCommand::SetV:
    m_limits.maxSpeed = std::min(metres, most.maxSpeed);
    break;
  case ArcosCommand::SetRv:
    m_limits.maxTurnRate = std::min(angle, most.maxTurnRate);
    break;
  case ArcosCommand::SetA:
    (argument < 0 ? m_limits.deceleration : m_limits.acceleration) =
        std::min(metres, argument < 0 ? most.deceleration : most.acceleration);
    break;
  case ArcosCommand::SetRa:
    m_limits.turnAcceleration = std::min(angle, most.turnAcceleration);
    break;
  case ArcosCommand::Vel:
    m_wanted.v = argument / 1000.0;
    m_driving = true;
    break;
  case ArcosCommand::Rotate:
  case ArcosCommand::RVel:
    m_wanted.w = radians(argument);
    m_driving = true;
    break;
  default:
    break;
  }
}

void ArcosServer::setLaser(ArcosCommand command, int argument)
{
  switch (command) {
  case ArcosCommand::OldLaserEnable:
  case ArcosCommand::SimLaserEnable:
    m_laser.kind = std::clamp(argument, 0, 2);
    break;
  case ArcosCommand::OldLaserStart:
  case ArcosCommand::SimLaserStart:
    m_laser.start = std::clamp(argument, -180, 180);
    break;
  case ArcosCommand::OldLaserEnd:
  case ArcosCommand::SimLaserEnd:
    m_laser.end = std::clamp(argument, -180, 180);
    break;
  case ArcosCommand::OldLaserIncrement:
  case ArcosCommand::SimLaserIncrement:
    m_laser.increment = std::clamp(argument, 25, 1000);
    break;
  default:
    break;
  }
}

void ArcosServer::setPose(const Bytes &args)
{
  constexpr std::size_t kSize = 13; // a type byte and three numbers
  if (args.size() >= kSize) {
    m_kidnap =
        Pose2{wide(args, 1) / 1000.0, wide(args, 5) / 1000.0, wrapAngle(radians(wide(args, 9)))};
  }
}

std::optional<Pose2> ArcosServer::takeKidnap()
{
  return std::exchange(m_kidnap, std::nullopt);
}

void ArcosServer::stopWanting()
{
  m_wanted = {};
  m_driving = true; // until it stands
}

void ArcosServer::hangUp()
{
  stopWanting();
  m_phase = Phase::Sync;
  m_motors = false;
  m_sonar = true;
  m_laser = {};
  m_limits = m_options.limits;
}

void ArcosServer::press(const PioneerSwitches &switches)
{
  m_switches = switches;
  if (m_switches.emergencyStop || m_switches.motorsOff) {
    m_motors = false;
    stopWanting();
  }
  if (m_switches.emergencyStop) {
    m_ramped = {};
  }
}

std::vector<Bytes> ArcosServer::takeOutput()
{
  return std::exchange(m_output, {});
}

void ArcosServer::step(Time now, MobileBase &base, LaserScanner &laser)
{
  if (m_phase == Phase::Open && now - m_lastCommand > m_options.watchdog) {
    m_wanted = {};
  }
  drive(now, base);
  if (m_phase != Phase::Open || now < m_nextSip) {
    return;
  }
  m_nextSip = std::max(m_nextSip + m_options.cycle, now);
  const BaseState state = base.state();
  if (std::exchange(m_resetOdometry, false)) {
    m_origin = state.odometry;
  }
  send(encodeSip(sip(state)));
  if (m_laser.kind != 0) {
    if (const std::optional<Scan> scan = laser.scan()) {
      sendScan(*scan);
    }
  }
}

void ArcosServer::drive(Time now, MobileBase &base)
{
  const double seconds = toSeconds(now - m_lastStep.value_or(now));
  m_lastStep = now;
  if (!m_driving) {
    return;
  }
  const Twist2 wanted = m_motors ? m_wanted : Twist2{};
  const double v = std::clamp(wanted.v, -m_limits.maxSpeed, m_limits.maxSpeed);
  const double w = std::clamp(wanted.w, -m_limits.maxTurnRate, m_limits.maxTurnRate);
  m_ramped.v = ramp(m_ramped.v, v, m_limits.acceleration, m_limits.deceleration, seconds);
  m_ramped.w = ramp(m_ramped.w, w, m_limits.turnAcceleration, m_limits.turnAcceleration, seconds);
  base.drive(m_ramped);
  m_driving = m_ramped.v != 0.0 || m_ramped.w != 0.0 || v != 0.0 || w != 0.0;
}

ArcosSip ArcosServer::sip(const BaseState &state) const
{
  const Pose2 pose = m_origin.inverse() * state.odometry;
  const double half = state.velocity.w / m_units.turnPerDiff;
  ArcosSip sip;
  sip.moving = state.velocity.v != 0.0 || state.velocity.w != 0.0;
  sip.x = counter(pose.x / m_units.distance);
  sip.y = counter(pose.y / m_units.distance);
  sip.heading = whole<std::int16_t>(pose.heading / m_units.angle);
  sip.leftSpeed = whole<std::int16_t>((state.velocity.v - half) / m_units.speed);
  sip.rightSpeed = whole<std::int16_t>((state.velocity.v + half) / m_units.speed);
  sip.battery = kBattery;
  sip.stall = static_cast<std::uint16_t>((state.stalled ? ArcosSip::kWheels : 0U) |
                                         (m_switches.frontBumper ? kFrontBumper : 0U) |
                                         (m_switches.rearBumper ? kRearBumper : 0U));
  sip.control = sip.heading;
  sip.flags = static_cast<std::uint16_t>(
      (m_motors ? ArcosSip::kMotorsOn : 0U) | (m_sonar ? ArcosSip::kSonarOn : 0U) |
      (m_switches.emergencyStop ? ArcosSip::kEmergencyStop : 0U));
  sip.turnRate = whole<std::int16_t>(10.0 * degrees(state.velocity.w));
  for (std::size_t i = 0; m_sonar && i < state.sonar.size(); ++i) {
    const double range = state.sonar[i].range / m_units.range;
    sip.sonars.push_back(
        {static_cast<std::uint8_t>(i), std::isnan(range) ? kNoEcho : whole<std::uint16_t>(range)});
  }
  return sip;
}

void ArcosServer::sendScan(const Scan &scan)
{
  const int count = (m_laser.end - m_laser.start) * 100 / m_laser.increment + 1;
  if (count < 2) {
    return;
  }
  const std::vector<std::uint16_t> ranges =
      sampleScan(scan, radians(m_laser.start), radians(m_laser.increment / 100.0),
                 static_cast<std::size_t>(count), 1e-3, kLaserWords);
  for (const ArcosPacket &packet :
       encodeLaserSweep(m_laser.kind == 1 ? kLaserPlain : kLaserExtended, ranges)) {
    send(packet);
  }
}

ArcosConfig ArcosServer::config() const
{
  const Limits &limits = m_options.limits;
  ArcosConfig config;
  config.subclass = m_options.subclass;
  config.serial = "SIM";
  config.name = m_options.name;
  config.firmware = "1.0";
  config.sipCycle = whole<std::uint8_t>(1000.0 * toSeconds(m_options.cycle));
  config.watchdog = whole<std::uint16_t>(1000.0 * toSeconds(m_options.watchdog));
  config.speedMax = whole<std::uint16_t>(1000.0 * limits.maxSpeed);
  config.turnRateMax = whole<std::uint16_t>(degrees(limits.maxTurnRate));
  config.acceleration = whole<std::uint16_t>(1000.0 * limits.acceleration);
  config.deceleration = whole<std::uint16_t>(1000.0 * limits.deceleration);
  config.turnAcceleration = whole<std::uint16_t>(degrees(limits.turnAcceleration));
  config.turnDeceleration = config.turnAcceleration;
  return config;
}

} // namespace homeward
