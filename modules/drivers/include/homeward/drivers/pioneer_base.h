// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/protocol/arcos.h>
#include <homeward/drivers/protocol/arcos_laser.h>
#include <homeward/drivers/steady_clock.h>
#include <homeward/drivers/velocity_rounder.h>
#include <homeward/robot/laser_scanner.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/robot/rig.h>
#include <homeward/robot/robot_description.h>

#include <functional>
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
  std::vector<int> bauds;                  ///< tried in turn on a serial line; empty: as it is set
  PioneerLaser laser = PioneerLaser::None; ///< 180 degrees ahead in half degrees
  double clockRate = 1.0;                  ///< see SteadyClock
  Duration commandLife = std::chrono::milliseconds(500); ///< drive() holds this long, then zero
  Duration pulse = std::chrono::milliseconds(500);       ///< keep-alive when nothing else is said
  Duration answerTimeout =
      std::chrono::seconds(1);                ///< of one try of the handshake; ours, motors too
  Duration silence = std::chrono::seconds(2); ///< without a packet: the robot counts as gone
};

/**
 * A Pioneer behind its ARCOS protocol. One thread reads its packets, keeps it awake and brings it
 * to a stop when drive() is no longer called.
 *
 * Whatever switches the motors off (the emergency stop, the motors button, a link that was lost)
 * halts it: it is told to stand, BaseState::halt says why, and no velocity but zero is taken until
 * enableMotors().
 */
class PioneerBase final : public MobileBase
{
public:
  /** Opens the line to the robot. @throw DeviceError when it cannot */
  using OpenLine = std::function<std::unique_ptr<ByteStream>()>;

  /**
   * Shakes hands, sets limits, waits for the first packet and enables the motors; one whose motors
   * stay off is halted.
   * @throw DeviceError when no Pioneer answers or its subclass is unknown and no units are given
   */
  PioneerBase(std::unique_ptr<ByteStream> stream, const PioneerOptions &options);

  /** Stops the robot, disables its motors and says goodbye. */
  ~PioneerBase() override;

  /** See VelocityRounder. @throw LogicError when not finite, DeviceError also when it is halted */
  void drive(const Twist2 &twist) override;
  BaseState state() override;

  /**
   * Says goodbye over the line there was, if it still can, and connects over a new one. The motors
   * stay off and the robot is halted; odometry goes on where it was. Not while others use it.
   * @throw DeviceError when the same robot does not answer; then it is lost as before
   */
  void reconnect(const OpenLine &open);

  /**
   * Lets a halted robot drive again: tells it to stand and switches its motors on.
   * @throw DeviceError when they stay off, for example because the emergency stop is still pressed
   */
  void enableMotors();

  /**
   * Stops as hard as the robot can, whatever its deceleration is set to; the next drive() drives
   * again. While others use it too, from any thread.
   * @throw DeviceError when there is no connection
   */
  void emergencyStop();

  /** Volts of its battery, as its last packet says; nothing before the first. From any thread. */
  std::optional<double> battery();

  /** What its packets count in, see PioneerOptions::units. */
  const ArcosUnits &units() const { return m_units; }

  /** The speed at which it answered, the last of PioneerOptions::bauds tried; 0 without these. */
  int baud() const { return m_baud; }

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

  void connect();
  void configure();
  void askForLaser();
  void awaitFirstPacket();
  void disconnect();
  void sayGoodbye();
  void refuseAnother(const ArcosIdentity &known) const;
  void start();
  void run(const std::stop_token &stop);
  void readPackets();
  void take(const ArcosSip &sip, Time now);
  void take(const ArcosLaserPart &part, Time now);
  std::optional<Scan> newestScan();
  void heedSwitches(const ArcosSip &sip); ///< needs m_knowing
  std::string haltReason();
  bool motorsComeOn(Duration patience);
  void keepAwake(Time now);
  void send(const ArcosPacket &command);            ///< needs m_writing
  void sendVelocity(const WholeVelocity &velocity); ///< needs m_writing
  void sendZero();                                  ///< needs m_writing
  void refuseWhenGone();

  PioneerOptions m_options;
  SteadyClock m_clock{m_options.clockRate};
  std::unique_ptr<ByteStream> m_stream;
  ArcosReader m_reader;
  ArcosIdentity m_identity;
  ArcosUnits m_units;
  ArcosOdometry m_odometry{m_units};
  Pose2 m_origin; ///< of the connection's odometry in that of the base
  int m_baud = 0; ///< see baud()

  std::mutex m_writing;
  VelocityRounder m_rounder{m_options.limits};
  bool m_motorsWanted = false; ///< switched on by us and not halted since
  bool m_commanded = false;    ///< drive() is to be heeded until it expires
  Time m_lastCommand{};        ///< of drive()
  Time m_lastSent{};           ///< of anything

  std::mutex m_knowing;
  std::optional<BaseState> m_state;
  std::optional<Scan> m_scan;
  std::optional<double> m_battery; ///< volts
  bool m_heard = false;            ///< a packet came over this connection
  bool m_motorsOn = false;         ///< they were, since they were enabled
  std::string m_halt;              ///< see BaseState
  ArcosSweepReader m_sweeps;       ///< of the thread alone
  std::string m_failure;           ///< why there is no connection

  Laser m_laser{*this};
  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace homeward
