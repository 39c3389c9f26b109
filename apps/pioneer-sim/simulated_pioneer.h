// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "arcos_server.h"
#include "client_line.h"
#include "faults.h"
#include "faulty_devices.h"
#include "lms_server.h"

#include <homeward/sim/simulator.h>

#include <atomic>
#include <mutex>
#include <string>

namespace homeward
{

/** Where and how the simulated robot can be reached. */
struct PioneerSimOptions
{
  std::string host = "127.0.0.1";
  int port = 0;       ///< of ARCOS; 0 lets the system choose
  double speed = 1.0; ///< seconds of the robot's life in one of the machine's
  ArcosServerOptions arcos;
};

/**
 * The simulated robot behind its real protocols: ARCOS on a TCP port and on a pseudo-terminal, a
 * LMS-200 on another one. One thread, the caller of run(), moves the world and serves them all.
 */
class SimulatedPioneer
{
public:
  /** `simulator` and `faults` must outlive it. @throw DeviceError when a line cannot be opened */
  SimulatedPioneer(Simulator &simulator, const PioneerSimOptions &options, const Faults &faults);

  int port() const { return m_tcp.port(); }
  const std::string &arcosPty() const { return m_pty.path(); }
  const std::string &lmsPty() const { return m_lmsPty.path(); }

  /** Serves until `stop`. */
  void run(const std::atomic<bool> &stop);

  /** What only the simulator knows, after the last step; any thread may ask. */
  struct Snapshot
  {
    Time now{};
    Truth truth;
    Twist2 velocity; ///< of the wheels
  };
  Snapshot snapshot() const;

private:
  void waitForBytes(std::chrono::nanoseconds atMost);
  void hear();
  void step();
  void hear(ArcosServer &server, ClientLine &line, Time now);
  void speak(ArcosServer &server, ClientLine &line);
  Bytes onTheLine(const Bytes &packet) const;
  void carryAway(ArcosServer &server);
  void remember();

  Simulator &m_simulator;
  const Faults &m_faults;
  FaultyBase m_base;
  FaultyLaser m_laser;
  double m_speed;
  ArcosServer m_tcpServer;
  ArcosServer m_ptyServer;
  LmsServer m_lms;
  TcpLine m_tcp;
  PtyLine m_pty;
  PtyLine m_lmsPty;

  mutable std::mutex m_mutex;
  Snapshot m_snapshot;
};

} // namespace homeward
