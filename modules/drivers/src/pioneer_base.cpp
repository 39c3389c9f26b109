// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/pioneer_base.h>

#include "pioneer_handshake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace homeward
{
namespace
{

/** How long the thread waits for bytes before it looks at its watch. */
constexpr Duration kTick = std::chrono::milliseconds(20);

// What the packets of a simulated laser hold.
constexpr int kLaserEnd = 90;              ///< degrees to either side
constexpr int kLaserIncrement = 50;        ///< hundredths of a degree
constexpr std::uint16_t kLaserFar = 32000; ///< mm, and more: nothing was in the way

int toWhole(double value)
{
  return static_cast<int>(std::lround(value));
}

int millimetres(double metres)
{
  return toWhole(1000.0 * metres);
}

int wholeDegrees(double angle)
{
  return toWhole(degrees(angle));
}

} // namespace

PioneerBase::PioneerBase(std::unique_ptr<ByteStream> stream, const PioneerOptions &options)
    : m_options(options), m_stream(std::move(stream))
{
  connect();
  start();
  try {
    enableMotors();
  }
  catch (const DeviceError &) { // halted, which state() tells
  }
}

PioneerBase::~PioneerBase()
{
  disconnect();
}

void PioneerBase::connect()
{
  const ArcosConnection found =
      shakeHands(*m_stream, m_reader, m_options.answerTimeout, m_options.bauds);
  m_identity = found.identity;
  m_baud = found.baud;
  const std::optional<ArcosUnits> units =
      m_options.units ? m_options.units : ArcosUnits::of(m_identity.subclass);
  if (!units) {
    sayGoodbye();
    throw DeviceError("robot '" + m_identity.name + "' is of subclass '" + m_identity.subclass +
                      "', whose units are unknown; name its ARIA parameter file");
  }
  m_units = *units;
  m_odometry = ArcosOdometry(m_units);
  try {
    configure();
    awaitFirstPacket();
  }
  catch (const DeviceError &) {
    sayGoodbye();
    throw;
  }
}

void PioneerBase::start()
{
  m_thread = std::jthread([this](const std::stop_token &stop) { run(stop); });
}

void PioneerBase::disconnect()
{
  m_thread.request_stop();
  if (m_thread.joinable()) {
    m_thread.join();
  }
  const std::lock_guard lock(m_writing);
  sayGoodbye();
  m_stream.reset();
}

void PioneerBase::sayGoodbye()
{
  try {
    sendZero();
    send(arcosCommand(ArcosCommand::Enable, 0));
    send(arcosCommand(ArcosCommand::Close, 1));
  }
  catch (const DeviceError &) { // it is gone, so it cannot be told
  }
}

void PioneerBase::reconnect(const OpenLine &open)
{
  disconnect();
  {
    const std::lock_guard lock(m_knowing);
    m_failure = m_failure.empty() ? "it has not been reached again" : m_failure;
    m_halt = "the link to it was lost and is back; its motors are off";
    m_motorsOn = m_heard = false;
    m_origin = m_state->odometry;
  }
  const ArcosIdentity known = m_identity;
  const std::lock_guard lock(m_writing);
  m_motorsWanted = false;
  m_reader = ArcosReader();
  m_stream = open();
  try {
    connect();
    refuseAnother(known);
  }
  catch (const DeviceError &) {
    sayGoodbye();
    m_stream.reset();
    m_identity = known;
    throw;
  }
  {
    const std::lock_guard knowing(m_knowing);
    m_failure.clear();
  }
  start();
}

void PioneerBase::refuseAnother(const ArcosIdentity &known) const
{
  if (m_identity.name != known.name || m_identity.subclass != known.subclass) {
    throw DeviceError("robot '" + m_identity.name + "' (" + m_identity.subclass +
                      ") answers where '" + known.name + "' (" + known.subclass +
                      ") was; start anew if that is meant");
  }
}

void PioneerBase::enableMotors()
{
  {
    const std::lock_guard lock(m_writing);
    refuseWhenGone();
    sendZero();
    m_motorsWanted = true;
    const std::lock_guard knowing(m_knowing);
    m_halt.clear();
    m_motorsOn = false;
  }
  constexpr int kTries = 4; // what is sent may get lost on the way
  for (int attempt = 0; attempt < kTries; ++attempt) {
    {
      const std::lock_guard lock(m_writing);
      send(arcosCommand(ArcosCommand::Enable, 1));
    }
    if (motorsComeOn(m_options.answerTimeout / kTries)) {
      return;
    }
  }
  const std::lock_guard lock(m_knowing);
  m_halt = m_motorsOn ? m_halt : "its motors stay off; is its emergency stop pressed?";
  if (!m_halt.empty()) {
    throw DeviceError("robot '" + m_identity.name + "' does not drive: " + m_halt);
  }
}

bool PioneerBase::motorsComeOn(Duration patience)
{
  SteadyClock wall;
  const Time deadline = wall.now() + patience;
  while (wall.now() < deadline) {
    {
      const std::lock_guard lock(m_knowing);
      if (m_motorsOn) {
        return true;
      }
    }
    wall.sleepUntil(wall.now() + kTick);
  }
  return false;
}

void PioneerBase::configure()
{
  const Limits &limits = m_options.limits;
  send(arcosCommand(ArcosCommand::Enable, 0)); // some have them on from the beginning
  send(arcosCommand(ArcosCommand::SetV, millimetres(limits.maxSpeed)));
  send(arcosCommand(ArcosCommand::SetA, millimetres(limits.acceleration)));
  send(arcosCommand(ArcosCommand::SetA, -millimetres(limits.deceleration)));
  send(arcosCommand(ArcosCommand::SetRv, wholeDegrees(limits.maxTurnRate)));
  send(arcosCommand(ArcosCommand::SetRa, wholeDegrees(limits.turnAcceleration)));
  send(arcosCommand(ArcosCommand::SetRa, -wholeDegrees(limits.turnAcceleration)));
  send(arcosCommand(ArcosCommand::Sonar, m_options.sonars.empty() ? 0 : 1));
  askForLaser();
}

void PioneerBase::askForLaser()
{
  if (m_options.laser == PioneerLaser::None) {
    return;
  }
  send(arcosCommand(ArcosCommand::OldLaserStart, -kLaserEnd));
  send(arcosCommand(ArcosCommand::OldLaserEnd, kLaserEnd));
  send(arcosCommand(ArcosCommand::OldLaserIncrement, kLaserIncrement));
  send(arcosCommand(ArcosCommand::OldLaserEnable, m_options.laser == PioneerLaser::Plain ? 1 : 2));
}

void PioneerBase::awaitFirstPacket()
{
  const Time deadline = m_clock.now() + m_options.silence;
  while (!m_heard) {
    if (m_clock.now() >= deadline) {
      throw DeviceError("robot '" + m_identity.name + "' opened but sends no packets");
    }
    readPackets();
  }
}

void PioneerBase::run(const std::stop_token &stop)
{
  try {
    while (!stop.stop_requested()) {
      readPackets();
      keepAwake(m_clock.now());
    }
  }
  catch (const std::exception &error) {
    {
      const std::lock_guard lock(m_knowing);
      m_failure = error.what();
    }
    const std::lock_guard lock(m_writing);
    sayGoodbye(); // where only one direction is broken it stands at once
  }
}

void PioneerBase::readPackets()
{
  std::array<std::uint8_t, 512> buffer{};
  const std::size_t count = m_stream->read(buffer, kTick);
  m_reader.push(std::span(buffer).first(count), SteadyClock().now());
  const Time now = m_clock.now();
  while (const std::optional<ArcosPacket> packet = m_reader.next()) {
    if (const std::optional<ArcosSip> sip = parseSip(*packet)) {
      take(*sip, now);
    }
    else if (const std::optional<ArcosLaserPart> part = parseLaserPart(*packet)) {
      take(*part, now);
    }
  }
}

void PioneerBase::take(const ArcosLaserPart &part, Time now)
{
  const auto sweep = m_sweeps.add(part);
  if (!sweep || sweep->size() != 2 * kLaserEnd * 100 / kLaserIncrement + 1) {
    return;
  }
  Scan scan;
  scan.stamp = now;
  scan.angleMin = -radians(kLaserEnd);
  scan.angleStep = radians(kLaserIncrement / 100.0);
  scan.rangeMax = kLaserFar / 1000.0;
  for (const std::uint16_t range : *sweep) {
    scan.ranges.push_back(range == 0 ? kUnknownRange : static_cast<float>(range) / 1000.0F);
  }
  const std::lock_guard lock(m_knowing);
  m_scan = std::move(scan);
}

std::optional<Scan> PioneerBase::newestScan()
{
  refuseWhenGone();
  const std::lock_guard lock(m_knowing);
  return m_scan;
}

LaserScanner &PioneerBase::laser()
{
  if (m_options.laser == PioneerLaser::None) {
    throw LogicError("laser of a Pioneer that was not asked for one");
  }
  return m_laser;
}

void PioneerBase::take(const ArcosSip &sip, Time now)
{
  const std::lock_guard lock(m_knowing);
  if (!m_state) {
    m_state.emplace();
    for (const SonarMount &mount : m_options.sonars) {
      m_state->sonar.push_back(
          {mount.bearing, mount.x, mount.y, std::numeric_limits<double>::quiet_NaN()});
    }
  }
  constexpr std::uint16_t kNoEcho = 5000; // mm, what the transducers report when nothing echoed
  const Pose2 odometry = m_odometry.update(sip);
  if (!std::exchange(m_heard, true)) {
    m_origin = m_origin * odometry.inverse();
  }
  m_battery = 0.1 * sip.battery;
  m_state->stamp = now;
  m_state->odometry = m_origin * odometry;
  m_state->velocity = arcosVelocity(sip, m_units);
  m_state->stalled = sip.wheelStalled();
  m_state->bumpedAhead = sip.bumpedAhead();
  m_state->bumpedBehind = sip.bumpedBehind();
  heedSwitches(sip);
  for (const ArcosSonar &echo : sip.sonars) {
    if (echo.index < m_state->sonar.size()) {
      m_state->sonar[echo.index].range = echo.range >= kNoEcho
                                             ? std::numeric_limits<double>::quiet_NaN()
                                             : echo.range * m_units.range;
    }
  }
}

void PioneerBase::heedSwitches(const ArcosSip &sip)
{
  if (sip.motorsOn() && !sip.emergencyStop()) {
    m_motorsOn = true;
  }
  else if (m_motorsOn && m_halt.empty()) {
    m_halt = sip.emergencyStop() ? "its emergency stop is pressed" : "its motors were switched off";
  }
}

std::string PioneerBase::haltReason()
{
  const std::lock_guard lock(m_knowing);
  return m_halt;
}

void PioneerBase::keepAwake(Time now)
{
  const std::lock_guard lock(m_writing);
  if (m_motorsWanted && !haltReason().empty()) {
    // Its own button may switch the motors on again: then it must want nothing.
    sendZero();
    send(arcosCommand(ArcosCommand::Enable, 0));
    m_motorsWanted = false;
  }
  else if (m_commanded && now - m_lastCommand > m_options.commandLife) {
    sendZero();
  }
  else if (now - m_lastSent > m_options.pulse) {
    send(arcosCommand(ArcosCommand::Pulse));
  }
}

void PioneerBase::send(const ArcosPacket &command)
{
  if (!m_stream) {
    throw DeviceError("robot '" + m_identity.name + "' is not connected");
  }
  m_stream->write(frameArcos(command));
  m_lastSent = m_clock.now();
}

void PioneerBase::sendVelocity(const WholeVelocity &velocity)
{
  send(arcosCommand(ArcosCommand::Vel, velocity.speed));
  send(arcosCommand(ArcosCommand::RVel, velocity.turnRate));
}

void PioneerBase::sendZero()
{
  m_rounder.forget();
  m_commanded = false;
  sendVelocity({});
}

void PioneerBase::refuseWhenGone()
{
  const std::lock_guard lock(m_knowing);
  if (!m_failure.empty()) {
    throw DeviceError("robot '" + m_identity.name + "' is lost: " + m_failure);
  }
  const Duration age = m_clock.now() - m_state->stamp;
  if (age > m_options.silence) {
    throw DeviceError("robot '" + m_identity.name + "' has been silent for " +
                      std::to_string(toSeconds(age)) + " s");
  }
}

void PioneerBase::drive(const Twist2 &twist)
{
  refuseWhenGone();
  const bool stands = twist.v == 0.0 && twist.w == 0.0;
  const std::lock_guard lock(m_writing);
  if (const std::string halt = haltReason(); !halt.empty() && !stands) {
    throw DeviceError("robot '" + m_identity.name + "' does not drive: " + halt);
  }
  const WholeVelocity velocity = m_rounder.next(twist);
  m_commanded = !stands;
  sendVelocity(velocity);
  m_lastCommand = m_lastSent;
}

void PioneerBase::emergencyStop()
{
  const std::lock_guard lock(m_writing);
  m_rounder.forget();
  m_commanded = false;
  send(arcosCommand(ArcosCommand::EStop));
}

std::optional<double> PioneerBase::battery()
{
  const std::lock_guard lock(m_knowing);
  return m_battery;
}

BaseState PioneerBase::state()
{
  refuseWhenGone();
  const std::lock_guard lock(m_knowing);
  BaseState state = *m_state;
  state.halt = m_halt;
  return state;
}

} // namespace homeward
