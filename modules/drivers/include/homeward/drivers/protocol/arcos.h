// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/time.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/** The packets that a Pioneer and its client exchange (ARCOS, P2OS): both directions, no I/O. */
namespace homeward
{

/** Bytes as they travel. */
using Bytes = std::vector<std::uint8_t>;

/** Client commands that this project speaks. The comment names the argument. */
enum class ArcosCommand : std::uint8_t
{
  Sync0 = 0,
  Sync1 = 1,
  Sync2 = 2,
  Pulse = 0,   ///< keep-alive, the same frame as Sync0
  Open = 1,    ///< with or without argument; without it is the same frame as Sync1
  Close = 2,   ///< 1
  Enable = 4,  ///< motors, 1 or 0
  SetA = 5,    ///< mm/s^2; negative sets the deceleration
  SetV = 6,    ///< largest speed, mm/s
  SetO = 7,    ///< odometry to zero
  Rotate = 9,  ///< deg/s, as RVel
  SetRv = 10,  ///< largest turn rate, deg/s
  Vel = 11,    ///< mm/s
  Config = 18, ///< asks for the configuration packet
  RVel = 21,   ///< deg/s, counter-clockwise
  SetRa = 23,  ///< deg/s^2; negative sets the deceleration
  Sonar = 28,  ///< 1 or 0
  Stop = 29,
  Vel2 = 32, ///< two signed bytes, right then left wheel, 20 mm/s each
  EStop = 55,
  // Of simulators only; a real robot passes over them.
  OldLaserEnable = 35,    ///< 1 asks for packets 0x60, 2 for 0x61, 0 for none
  OldLaserStart = 36,     ///< deg, counter-clockwise
  OldLaserEnd = 37,       ///< deg
  OldLaserIncrement = 38, ///< 0.01 deg
  SimSetPose = 224,       ///< type byte, then three int32: mm, mm, deg; odometry does not notice
  SimLaserEnable = 230,   ///< as OldLaserEnable; a laser's index may follow
  SimLaserStart = 231,    ///< deg
  SimLaserEnd = 232,      ///< deg
  SimLaserIncrement = 233 ///< 0.01 deg
};

/** Packet ids of the standard server information packet. */
inline constexpr std::uint8_t kSipStopped = 0x32;
/** Id of a server information packet of a robot that moves. */
inline constexpr std::uint8_t kSipMoving = 0x33;

/** One packet without its frame: a command's number or a packet's type, then its arguments. */
struct ArcosPacket
{
  std::uint8_t id = 0; ///< command, or kind of information
  Bytes args;          ///< what follows it, without the checksum

  bool operator==(const ArcosPacket &) const = default;
};

/** Pairs of bytes (high, low) added modulo 2^16; a byte left over is XORed. */
std::uint16_t arcosChecksum(std::span<const std::uint8_t> idAndArgs);

/** The packet in its frame: FA FB, length, packet, checksum. @throw LogicError above 200 bytes */
Bytes frameArcos(const ArcosPacket &packet);

/** A command without argument. */
ArcosPacket arcosCommand(ArcosCommand command);

/** A command with a whole-number argument. @throw LogicError unless |argument| <= 32767 */
ArcosPacket arcosCommand(ArcosCommand command, int argument);

/** The whole-number argument of a command; nothing where none is or it is cut short. */
std::optional<int> arcosArgument(const ArcosPacket &command);

/**
 * Cuts a stream of bytes into packets. Anything that is no frame is skipped; a frame with a bad
 * checksum is dropped in silence, and so is one that pauses for more than 100 ms.
 */
class ArcosReader
{
public:
  /** Takes bytes that came at `now`. */
  void push(std::span<const std::uint8_t> bytes, Time now);

  /** The next whole packet; nothing until more bytes come. */
  std::optional<ArcosPacket> next();

private:
  Bytes m_bytes;
  std::size_t m_begin = 0; ///< of what has not been read yet
  Time m_lastByte{};
};

/** What a robot says of itself in the answer to SYNC2. */
struct ArcosIdentity
{
  std::string name;       ///< given by its owner
  std::string robotClass; ///< "Pioneer"
  std::string subclass;   ///< "p3at": picks the conversion factors
};

/** The packet that says it. */
ArcosPacket encodeIdentity(const ArcosIdentity &identity);

/** Nothing when it is another packet. */
std::optional<ArcosIdentity> parseIdentity(const ArcosPacket &packet);

/** One echo in a SIP. */
struct ArcosSonar
{
  std::uint8_t index = 0;  ///< of the transducer
  std::uint16_t range = 0; ///< range units

  bool operator==(const ArcosSonar &) const = default;
};

/** The standard server information packet, in the robot's own units. */
struct ArcosSip
{
  bool moving = false;                  ///< the packet says that the robot moves
  std::uint16_t x = 0;                  ///< distance units, a counter modulo 2^15 or 2^16
  std::uint16_t y = 0;                  ///< distance units
  std::int16_t heading = 0;             ///< angle units
  std::int16_t leftSpeed = 0;           ///< speed units
  std::int16_t rightSpeed = 0;          ///< speed units
  std::uint8_t battery = 0;             ///< 0.1 V
  std::uint16_t stall = 0;              ///< wheels and bumpers that are held
  std::int16_t control = 0;             ///< heading set point, angle units
  std::uint16_t flags = 0;              ///< motors, sonar, emergency stop
  std::uint8_t compass = 0;             ///< 2 deg
  std::vector<ArcosSonar> sonars;       ///< echoes that are new
  std::optional<std::int16_t> turnRate; ///< 0.1 deg/s; old robots do not say

  /** The motors are on. */
  bool motorsOn() const { return (flags & kMotorsOn) != 0; }
  /** The emergency stop is pressed. */
  bool emergencyStop() const { return (flags & kEmergencyStop) != 0; }
  /** A wheel is held. */
  bool wheelStalled() const { return (stall & kWheels) != 0; }
  /** A bumper at the front is pressed. */
  bool bumpedAhead() const { return (stall & kFrontBumpers) != 0; }
  /** A bumper at the rear is pressed. */
  bool bumpedBehind() const { return (stall & kRearBumpers) != 0; }

  // Bits of `flags` and `stall`.
  static constexpr std::uint16_t kMotorsOn = 0x0001;      ///< bit of flags
  static constexpr std::uint16_t kSonarOn = 0x001E;       ///< bits of flags
  static constexpr std::uint16_t kEmergencyStop = 0x0020; ///< bit of flags
  static constexpr std::uint16_t kWheels = 0x0101;        ///< bits of stall
  static constexpr std::uint16_t kRearBumpers = 0x00FE;   ///< bits of stall
  static constexpr std::uint16_t kFrontBumpers = 0xFE00;  ///< bits of stall

  bool operator==(const ArcosSip &) const = default;
};

/** The packet that a robot sends; a SIP with turnRate carries the full tail, else none. */
ArcosPacket encodeSip(const ArcosSip &sip);

/** Nothing when it is another packet or one cut short before its sonars end. */
std::optional<ArcosSip> parseSip(const ArcosPacket &packet);

/** What the units of a robot's SIP are worth. */
struct ArcosUnits
{
  double distance = 1e-3;   ///< metres
  double angle = 0.001534;  ///< radians
  double speed = 1e-3;      ///< m/s
  double range = 1e-3;      ///< metres
  double turnPerDiff = 3.4; ///< rad/s per m/s of half the difference of the wheels' speeds

  /** Of a subclass that is known: p3at, p3at-sh. Nothing for others. */
  static std::optional<ArcosUnits> of(const std::string &subclass);
};

/** Follows a robot's counters through their wraps. */
class ArcosOdometry
{
public:
  /** Starts at the origin with the next packet. */
  explicit ArcosOdometry(const ArcosUnits &units) : m_units(units) {}

  /** The pose after this SIP; the first one places the origin at its counters' zero. */
  Pose2 update(const ArcosSip &sip);

private:
  ArcosUnits m_units;
  std::optional<ArcosSip> m_last;
  std::int64_t m_x = 0; ///< distance units
  std::int64_t m_y = 0; ///< distance units
};

/** Measured velocity; the turn rate from the wheels where the robot does not say it. */
Twist2 arcosVelocity(const ArcosSip &sip, const ArcosUnits &units);

} // namespace homeward
