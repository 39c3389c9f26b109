// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace homeward
{

/** How fast the robot may move and how hard it may be pushed. All positive. */
struct Limits
{
  double maxSpeed = 0.4;         ///< m/s
  double maxTurnRate = 0.7;      ///< rad/s
  double acceleration = 0.3;     ///< m/s^2, of the translation
  double deceleration = 0.5;     ///< m/s^2, when it brakes
  double turnAcceleration = 1.7; ///< rad/s^2, of the rotation, both ways
};

/** How the base is reached. */
struct BaseLink
{
  std::string address;              ///< `tcp:HOST:PORT`, or the path of a serial line
  int baud = 9600;                  ///< tried first; then the other usual ones are
  double period = 0.1;              ///< seconds between its packets
  std::filesystem::path parameters; ///< ARIA parameter file with the robot's units, as written;
                                    ///< empty: those of the subclass that it says it is of
};

/** Which laser there is and how it is reached. */
struct LaserLink
{
  /** What it speaks. */
  enum class Kind
  {
    Lms200, ///< SICK LMS-2xx on a serial line
    Lms1xx, ///< SICK LMS1xx on Ethernet
    Hokuyo, ///< a Hokuyo, on Ethernet or a serial line
    OnBase  ///< laser packets of a simulated robot, on the base's own connection
  };
  Kind kind = Kind::Lms200; ///< what it speaks
  std::string address;      ///< path of the serial line, or `tcp:HOST:PORT` of a LMS1xx or Hokuyo
  int baud = 38400;         ///< at which a LMS-2xx measures
  int resolution = 100;     ///< hundredths of a degree; 50 of a LMS1xx unless set
  double period = 0.1;      ///< seconds between its scans
};

/** Where pictures come from. */
struct CaptureLink
{
  /** How pictures come. */
  enum class Kind
  {
    Stream,   ///< a URL: MJPEG over HTTP, RTSP
    V4l2,     ///< number of a Video4Linux device
    Firewire, ///< number of a camera on the FireWire bus
    Files,    ///< numbered pictures, `pictures/%04d.png`
    Film      ///< a film file
  };
  Kind kind = Kind::Stream;       ///< how pictures come
  std::string source;             ///< address, device or file
  double period = 0.1;            ///< seconds between pictures
  double latency = 0.0;           ///< seconds from the light to the picture's arrival
  std::optional<double> exposure; ///< seconds, of a Video4Linux camera
  std::optional<int> shutter;     ///< of a FireWire camera, in its counts
  std::optional<int> gain;        ///< of either, in its counts
};

/** The real devices of a robot. */
struct DeviceLinks
{
  BaseLink base;            ///< wheels
  LaserLink laser;          ///< ranges
  CaptureLink capture;      ///< mirror pictures
  std::string stopJoystick; ///< device any button of which stops the robot; empty: none
  double clockRate = 1.0;   ///< seconds of its life in one of ours; 1 for everything real
};

/** What stands on the floor: which robot, which camera, and what is asked of them. */
struct Rig
{
  std::filesystem::path robot;        ///< URDF file, as written: relative to the rig file
  std::filesystem::path camera;       ///< camera file, as written: relative to the rig file
  Limits limits;                      ///< that the robot is never told to exceed
  std::optional<DeviceLinks> devices; ///< nothing: it exists in simulation only
};

/**
 * Reads the limits of a base: `max_speed_m_s`, `max_turn_rate_deg_s`, `acceleration_m_s2`,
 * `deceleration_m_s2`, `turn_acceleration_deg_s2`. What is left out keeps its default.
 * @throw ConfigError naming key, value and file: a key that is unknown, a value that is not a
 * positive number
 */
Limits parseLimits(const std::string &yaml, const std::string &origin);

/**
 * Reads a rig file: `robot: FILE`, `camera: FILE`, `limits: {...}` with the keys of parseLimits().
 * A rig of real devices has also
 * - `base: {address: tcp:HOST:PORT or /dev/..., baud: N, period_s: S, parameters:
 *   FILE.p}`,
 * - `laser: {kind: lms200, address: /dev/..., baud: N, resolution_deg: 1 or 0.5, period_s: S}`, or
 * `{kind: lms1xx, address: tcp:HOST:2111, resolution_deg: 0.5 or 0.25, period_s: S}`, or
 *   `{kind: hokuyo, address: tcp:HOST:10940 or /dev/..., period_s: S}`, or `{kind: on_base,
 *   period_s: S}`,
 * - `capture: {kind: stream, v4l2, firewire, files or film, source: ..., period_s: S, latency_s:
 *   S}`, for v4l2 also `exposure_ms: M` and `gain: N`, for firewire `shutter: N` and `gain: N`,
 * - where a joystick is to stop the robot, `stop_joystick: /dev/input/jsN`,
 * - and, where a simulated robot lives faster than we do, `clock_rate: N`.
 *
 * @param yaml its text
 * @param origin the file's name, for messages
 * @throw ConfigError naming key, value and file: a key that is unknown or missing, a number that is
 * not positive, a word that is none of those above
 */
Rig parseRig(const std::string &yaml, const std::string &origin);

} // namespace homeward
