// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/pioneer_base.h>

#include "pioneer_handshake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

Twist2 quantiseForPioneer(const Twist2 &twist, const Limits &limits)
{
  if (!std::isfinite(twist.v) || !std::isfinite(twist.w)) {
    throw LogicError("velocity (" + std::to_string(twist.v) + " m/s, " + std::to_string(twist.w) +
                     " rad/s) is not finite");
  }
  const double v = std::clamp(twist.v, -limits.maxSpeed, limits.maxSpeed);
  const double w = std::clamp(twist.w, -limits.maxTurnRate, limits.maxTurnRate);
  return {millimetres(v) / 1000.0, radians(wholeDegrees(w))};
}

PioneerBase::PioneerBase(std::unique_ptr<ByteStream> stream, const PioneerOptions &options)
    : m_options(options), m_stream(std::move(stream))
{
  m_identity = shakeHands(*m_stream, m_reader, m_options.answerTimeout);
  const std::optional<ArcosUnits> units =
      m_options.units ? m_options.units : ArcosUnits::of(m_identity.subclass);
  if (!units) {
    sayGoodbye();
    throw DeviceError("robot '" + m_identity.name + "' is of subclass '" + m_identity.subclass +
                      "', whose units are unknown; give them as PioneerOptions::units");
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
  m_thread = std::jthread([this](const std::stop_token &stop) { run(stop); });
}

PioneerBase::~PioneerBase()
{
  m_thread.request_stop();
  if (m_thread.joinable()) {
    m_thread.join();
  }
  sayGoodbye();
}

void PioneerBase::sayGoodbye()
{
  try {
    sendVelocity(0, 0);
    send(arcosCommand(ArcosCommand::Enable, 0));
    send(arcosCommand(ArcosCommand::Close, 1));
  }
  catch (const DeviceError &) { // it is gone, so it cannot be told
  }
}

void PioneerBase::configure()
{
  const Limits &limits = m_options.limits;
  send(arcosCommand(ArcosCommand::SetV, millimetres(limits.maxSpeed)));
  send(arcosCommand(ArcosCommand::SetA, millimetres(limits.acceleration)));
  send(arcosCommand(ArcosCommand::SetA, -millimetres(limits.deceleration)));
  send(arcosCommand(ArcosCommand::SetRv, wholeDegrees(limits.maxTurnRate)));
  send(arcosCommand(ArcosCommand::SetRa, wholeDegrees(limits.turnAcceleration)));
  send(arcosCommand(ArcosCommand::SetRa, -wholeDegrees(limits.turnAcceleration)));
  send(arcosCommand(ArcosCommand::Sonar, m_options.sonars.empty() ? 0 : 1));
  askForLaser();
  send(arcosCommand(ArcosCommand::Enable, 1));
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
  while (!m_state) {
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
    const std::lock_guard lock(m_knowing);
    m_failure = error.what();
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
  m_state->stamp = now;
  m_state->odometry = m_odometry.update(sip);
  m_state->velocity = arcosVelocity(sip, m_units);
  m_state->stalled = sip.wheelStalled();
  for (const ArcosSonar &echo : sip.sonars) {
    if (echo.index < m_state->sonar.size()) {
      m_state->sonar[echo.index].range = echo.range >= kNoEcho
                                             ? std::numeric_limits<double>::quiet_NaN()
                                             : echo.range * m_units.range;
    }
  }
}

void PioneerBase::keepAwake(Time now)
{
  const std::lock_guard lock(m_writing);
  if (m_commanded && now - m_lastCommand > m_options.commandLife) {
    sendVelocity(0, 0);
  }
  else if (now - m_lastSent > m_options.pulse) {
    send(arcosCommand(ArcosCommand::Pulse));
  }
}

void PioneerBase::send(const ArcosPacket &command)
{
  m_stream->write(frameArcos(command));
  m_lastSent = m_clock.now();
}

void PioneerBase::sendVelocity(int speed, int turnRate)
{
  m_commanded = speed != 0 || turnRate != 0;
  send(arcosCommand(ArcosCommand::Vel, speed));
  send(arcosCommand(ArcosCommand::RVel, turnRate));
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
  const Twist2 whole = quantiseForPioneer(twist, m_options.limits);
  refuseWhenGone();
  const std::lock_guard lock(m_writing);
  sendVelocity(millimetres(whole.v), wholeDegrees(whole.w));
  m_lastCommand = m_lastSent;
}

BaseState PioneerBase::state()
{
  refuseWhenGone();
  const std::lock_guard lock(m_knowing);
  return *m_state;
}

} // namespace homeward
