// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/arcos.h>
#include <homeward/drivers/protocol/arcos_config.h>
#include <homeward/robot/laser_scanner.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/robot/rig.h>

#include <optional>
#include <span>

namespace homeward
{

/** What a simulated controller is like. */
struct ArcosServerOptions
{
  std::string name = "pioneer-sim";
  std::string subclass = "p3at";                   ///< one that ArcosUnits knows
  Limits limits;                                   ///< of the base; a client may only lower them
  Duration cycle = std::chrono::milliseconds(100); ///< between information packets
  Duration watchdog = std::chrono::milliseconds(2000); ///< without a command: it stops
};

/** What somebody's hand, or a box in the way, does to a robot. */
struct PioneerSwitches
{
  bool emergencyStop = false; ///< pressed: it stops hard and its motors go off
  bool motorsOff = false;     ///< held on the motors button: they go off
  bool frontBumper = false;   ///< pressed
  bool rearBumper = false;    ///< pressed
};

/**
 * A Pioneer's controller as its client meets it, without I/O: bytes in, bytes out, time as an
 * argument. Motors are off until the client enables them. When the watchdog has stopped the robot,
 * or the client has gone, it stands until a new velocity comes.
 */
class ArcosServer
{
public:
  /** @throw ConfigError when nothing is known of the subclass */
  explicit ArcosServer(const ArcosServerOptions &options);

  /** Takes what a client sent. Commands that are unknown or cut short are passed over. */
  void receive(std::span<const std::uint8_t> bytes, Time now);

  /** Motors that went off stay so until the client enables them. */
  void press(const PioneerSwitches &switches);

  /** One step of robot time: velocity ramps, the watchdog, and a packet when it is due. */
  void step(Time now, MobileBase &base, LaserScanner &laser);

  /** What goes to the client now, packet by packet. */
  std::vector<Bytes> takeOutput();

  /** The client is gone: stops the robot and waits for another one. */
  void hangUp();

  /** Where a client wants the robot to be put in the world; forgotten when taken. */
  std::optional<Pose2> takeKidnap();

  /** A client has opened it. */
  bool isOpen() const { return m_phase == Phase::Open; }

private:
  enum class Phase
  {
    Sync,  ///< echoes what comes
    Ready, ///< has said who it is; OPEN is understood
    Open   ///< sends packets, obeys commands
  };
  struct LaserRequest
  {
    int kind = 0; ///< 0 none, 1 plain, 2 extended
    int start = -90;
    int end = 90;        ///< degrees
    int increment = 100; ///< hundredths of a degree
  };

  void shakeHands(const ArcosPacket &packet);
  void obey(const ArcosPacket &packet, Time now);
  void setMotion(ArcosCommand command, int argument);
  void setLaser(ArcosCommand command, int argument);
  void setPose(const Bytes &args);
  void drive(Time now, MobileBase &base);
  void stopWanting();
  ArcosSip sip(const BaseState &state) const;
  void sendScan(const Scan &scan);
  void send(const ArcosPacket &packet) { m_output.push_back(frameArcos(packet)); }
  ArcosConfig config() const;

  ArcosServerOptions m_options;
  ArcosUnits m_units;
  ArcosReader m_reader;
  std::vector<Bytes> m_output;
  Phase m_phase = Phase::Sync;
  Limits m_limits; ///< as the client has set them
  bool m_motors = false;
  PioneerSwitches m_switches;
  bool m_sonar = true;
  bool m_driving = false; ///< until it stands again after the last velocity
  Twist2 m_wanted;
  Twist2 m_ramped;
  LaserRequest m_laser;
  std::optional<Pose2> m_kidnap;
  bool m_resetOdometry = false;
  Pose2 m_origin; ///< odometry that the client sees as zero
  Time m_lastCommand{};
  std::optional<Time> m_lastStep;
  Time m_nextSip{};
};

} // namespace homeward
