// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulated_pioneer.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cstdio>

namespace homeward
{
namespace
{

using WallClock = std::chrono::steady_clock;

/** Robot time made up at once when the machine was busy; what is more is lost. */
constexpr double kMostCatchUp = 0.2; // s

} // namespace

SimulatedPioneer::SimulatedPioneer(Simulator &simulator, const PioneerSimOptions &options,
                                   const Faults &faults)
    : m_simulator(simulator), m_faults(faults), m_base(simulator.base(), faults),
      m_laser(simulator.laser(), faults), m_speed(options.speed), m_tcpServer(options.arcos),
      m_ptyServer(options.arcos), m_tcp(options.host, options.port)
{
  remember();
}

SimulatedPioneer::Snapshot SimulatedPioneer::snapshot() const
{
  const std::lock_guard lock(m_mutex);
  return m_snapshot;
}

void SimulatedPioneer::remember()
{
  Snapshot now{m_simulator.clock().now(), m_simulator.truth(), m_simulator.base().state().velocity};
  const std::lock_guard lock(m_mutex);
  m_snapshot = now;
}

void SimulatedPioneer::run(const std::atomic<bool> &stop)
{
  const double step = toSeconds(Simulator::kStep);
  WallClock::time_point begin = WallClock::now();
  double done = 0.0; // s of robot time since `begin`
  while (!stop) {
    const std::chrono::duration<double> passed = WallClock::now() - begin;
    const double behind = passed.count() * m_speed - done;
    if (behind > kMostCatchUp) {
      begin = WallClock::now();
      done = 0.0;
    }
    if (behind >= step) {
      hear();
      this->step();
      done += step;
      continue;
    }
    waitForBytes(std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::duration<double>((step - behind) / m_speed)));
    hear();
  }
}

void SimulatedPioneer::waitForBytes(std::chrono::nanoseconds atMost)
{
  std::vector<pollfd> waiting;
  m_tcp.watch(waiting);
  m_pty.watch(waiting);
  m_lmsPty.watch(waiting);
  const timespec timeout{
      0, static_cast<long>(std::clamp<std::int64_t>(atMost.count(), 0, 999'999'999))};
  ::ppoll(waiting.data(), waiting.size(), &timeout, nullptr);
}

void SimulatedPioneer::hear()
{
  const Time now = m_simulator.clock().now();
  hear(m_tcpServer, m_tcp, now);
  hear(m_ptyServer, m_pty, now);
  m_lms.receive(m_lmsPty.receive().bytes, m_lmsPty.baud());
  carryAway(m_tcpServer);
  carryAway(m_ptyServer);
  speak(m_tcpServer, m_tcp);
  speak(m_ptyServer, m_pty);
}

void SimulatedPioneer::hear(ArcosServer &server, ClientLine &line, Time now)
{
  if (m_faults.deafBase) {
    return;
  }
  const Arrival arrival = line.receive();
  server.receive(m_faults.wrongBaud ? garbled(arrival.bytes) : arrival.bytes, now);
  if (arrival.left) {
    server.hangUp();
  }
}

void SimulatedPioneer::carryAway(ArcosServer &server)
{
  if (const std::optional<Pose2> wMr = server.takeKidnap()) {
    try {
      m_simulator.kidnap(*wMr);
    }
    catch (const ConfigError &error) {
      std::fprintf(stderr, "pioneer-sim: %s\n", error.what());
    }
  }
}

void SimulatedPioneer::step()
{
  m_simulator.clock().sleepUntil(m_simulator.clock().now() + Simulator::kStep);
  const Time now = m_simulator.clock().now();
  for (ArcosServer *server : {&m_tcpServer, &m_ptyServer}) {
    server->press(
        {m_faults.emergencyStop, m_faults.motorsButton, m_faults.frontBumper, m_faults.rearBumper});
    server->step(now, m_base, m_laser);
  }
  speak(m_tcpServer, m_tcp);
  speak(m_ptyServer, m_pty);
  const Bytes telegrams = m_lms.step(Simulator::kStep, m_laser);
  if (!telegrams.empty() && !m_faults.silentLaser) {
    m_lmsPty.send(telegrams);
  }
  remember();
}

void SimulatedPioneer::speak(ArcosServer &server, ClientLine &line)
{
  constexpr std::size_t kIdAt = 3;
  for (const Bytes &packet : server.takeOutput()) {
    const bool laser = packet[kIdAt] == 0x60 || packet[kIdAt] == 0x61;
    if (m_faults.silentBase || (laser && m_faults.silentLaser)) {
      continue;
    }
    line.send(onTheLine(packet));
  }
}

Bytes SimulatedPioneer::onTheLine(const Bytes &packet) const
{
  constexpr std::size_t kHeader = 2;
  Bytes sent = m_faults.wrongBaud ? garbled(packet)
               : m_faults.garbage ? garbled(packet, kHeader)
                                  : packet;
  if (m_faults.badChecksums) {
    sent.back() ^= 1U;
  }
  if (m_faults.halfPackets) {
    sent.resize(sent.size() / 2);
  }
  return sent;
}

} // namespace homeward
