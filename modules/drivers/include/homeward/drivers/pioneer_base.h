// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/protocol/arcos.h>
#include <homeward/drivers/protocol/arcos_laser.h>
#include <homeward/drivers/steady_clock.h>
#include <homeward/robot/laser_scanner.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/robot/rig.h>
#include <homeward/robot/robot_description.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace homeward
{

/** Which packets of a simulated laser a Pioneer is asked for; a real robot has none. */
enum class PioneerLaser
{
  None,
  Plain,
  Extended
};

/** How a Pioneer is to be used. Durations are robot time but for `answerTimeout`. */
struct PioneerOptions
{
  Limits limits;                           ///< sent to the robot; drive() stays within them
  std::vector<SonarMount> sonars;          ///< by the robot's index; empty leaves the sonar off
  std::optional<ArcosUnits> units;         ///< instead of those of the robot's subclass
  PioneerLaser laser = PioneerLaser::None; ///< 180 degrees ahead in half degrees
  double clockRate = 1.0;                  ///< see SteadyClock
  Duration commandLife = std::chrono::milliseconds(500); ///< drive() holds this long, then zero
  Duration pulse = std::chrono::milliseconds(500);       ///< keep-alive when nothing else is said
  Duration answerTimeout = std::chrono::seconds(1);      ///< of one try of the handshake
  Duration silence = std::chrono::seconds(2); ///< without a packet: the robot counts as gone
};

/** The velocity that a Pioneer is told: whole mm/s and whole deg/s, within the limits. */
Twist2 quantiseForPioneer(const Twist2 &twist, const Limits &limits);

/**
 * A Pioneer behind its ARCOS protocol. One thread reads its packets, keeps it awake and brings it
 * to a stop when drive() is no longer called.
 */
class PioneerBase final : public MobileBase
{
public:
  /**
   * Shakes hands, sets limits, enables the motors and waits for the first packet.
   * @throw DeviceError when no Pioneer answers or its subclass is unknown and no units are given
   */
  PioneerBase(std::unique_ptr<ByteStream> stream, const PioneerOptions &options);

  /** Stops the robot, disables its motors and says goodbye. */
  ~PioneerBase() override;

  /** See quantiseForPioneer(). @throw LogicError when not finite */
  void drive(const Twist2 &twist) override;
  BaseState state() override;

  /** The laser on the robot's own connection. @throw LogicError unless it was asked for */
  LaserScanner &laser();

  /** What the robot said of itself. */
  const ArcosIdentity &identity() const { return m_identity; }

private:
  /** What the laser packets say. */
  class Laser final : public LaserScanner
  {
  public:
    explicit Laser(PioneerBase &base) : m_base(base) {}
    std::optional<Scan> scan() override { return m_base.newestScan(); }

  private:
    PioneerBase &m_base;
  };

  void configure();
  void askForLaser();
  void awaitFirstPacket();
  void sayGoodbye();
  void run(const std::stop_token &stop);
  void readPackets();
  void take(const ArcosSip &sip, Time now);
  void take(const ArcosLaserPart &part, Time now);
  std::optional<Scan> newestScan();
  void keepAwake(Time now);
  void send(const ArcosPacket &command);      ///< needs m_writing
  void sendVelocity(int speed, int turnRate); ///< needs m_writing; mm/s, deg/s
  void refuseWhenGone();

  PioneerOptions m_options;
  SteadyClock m_clock{m_options.clockRate};
  std::unique_ptr<ByteStream> m_stream;
  ArcosReader m_reader;
  ArcosIdentity m_identity;
  ArcosUnits m_units;
  ArcosOdometry m_odometry{m_units};

  std::mutex m_writing;
  bool m_commanded = false; ///< a velocity other than zero is set
  Time m_lastCommand{};     ///< of drive()
  Time m_lastSent{};        ///< of anything

  std::mutex m_knowing;
  std::optional<BaseState> m_state;
  std::optional<Scan> m_scan;
  ArcosSweepReader m_sweeps; ///< of the thread alone
  std::string m_failure;     ///< why the thread ended

  Laser m_laser{*this};
  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace homeward
