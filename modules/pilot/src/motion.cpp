// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/motion.h>

#include <homeward/core/error.h>
#include <homeward/laser/clearance.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace homeward
{
namespace
{

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

Footprint footprintOf(const RobotDescription &robot)
{
  const BodyPart around = robot.footprint();
  return {around.xMin, around.xMax, around.yMin, around.yMax};
}

Pose2 planar(const Eigen::Isometry3d &aMb)
{
  const Eigen::Matrix3d aRb = aMb.linear();
  return {aMb.translation().x(), aMb.translation().y(), std::atan2(aRb(1, 0), aRb(0, 0))};
}

/** The same arc, with no part of the body faster than `most`, m/s. */
Twist2 slowed(const Twist2 &twist, const Footprint &body, double most)
{
  const double x = std::max(std::abs(body.xMin), std::abs(body.xMax));
  const double y = std::max(std::abs(body.yMin), std::abs(body.yMax));
  const double corner = std::hypot(std::abs(twist.v) + std::abs(twist.w) * y, twist.w * x);
  const double share = most / std::max(most, corner);
  return {share * twist.v, share * twist.w};
}

LocalDrive::Options driveOptions(const MotionOptions &options)
{
  LocalDrive::Options drive;
  drive.maxSpeed = options.maxSpeed;
  drive.maxTurnRate = options.maxTurnRate;
  drive.margin = options.margin;
  drive.minMargin = options.minMargin;
  return drive;
}

LocalDrive::Options tightOptions(const MotionOptions &options)
{
  LocalDrive::Options drive = driveOptions(options);
  drive.maxSpeed = options.tightSpeed;
  drive.margin = options.minMargin;
  drive.minMargin = options.tightMargin;
  drive.safety.margin = options.tightMargin;
  return drive;
}

} // namespace

Motion::Motion(const Devices &devices, const RobotDescription &robot, const MotionOptions &options,
               const std::atomic<bool> &stop)
    : m_devices(devices), m_options(options), m_stop(stop), m_footprint(footprintOf(robot)),
      m_rMl(planar(robot.rMl)), m_safety(driveOptions(options).safety),
      m_localDrive(m_footprint, driveOptions(options)),
      m_tightDrive(m_footprint, tightOptions(options)), m_memory(options.memory),
      m_nextTick(devices.clock.now())
{}

Motion::~Motion()
{
  try {
    m_devices.base.drive({});
  }
  catch (const RuntimeError &) {
    // A base that is gone is stopped by its own watchdog.
    return;
  }
}

void Motion::read()
{
  m_nextTick = std::max(m_nextTick + fromSeconds(m_options.tickSeconds), m_devices.clock.now());
  m_devices.clock.sleepUntil(m_nextTick);
  m_sight.base = m_devices.base.state();
  if (!m_sight.base.halt.empty() && !m_stop) {
    throw DeviceError("the base does not drive: " + m_sight.base.halt);
  }
  m_sight.base.odometry = m_turns.follow(m_sight.base.odometry);
  m_sight.scan = m_devices.laser.scan();
  if (m_sight.scan && saysEnough(*m_sight.scan)) {
    m_laserSpoke = m_sight.scan->stamp;
  }
  constexpr std::size_t kPast = 30;
  if (m_past.empty() || m_past.back().stamp < m_sight.base.stamp) {
    m_past.push_back(m_sight.base);
  }
  if (m_past.size() > kPast) {
    m_past.pop_front();
  }
}

Pose2 Motion::poseAt(Time instant) const
{
  constexpr double kMostAhead = 0.3; // s
  if (m_past.empty() || instant == m_sight.base.stamp) {
    return pose();
  }
  const auto after = std::find_if(m_past.begin(), m_past.end(), [instant](const BaseState &state) {
    return state.stamp >= instant;
  });
  if (after == m_past.begin()) {
    return after->odometry;
  }
  if (after == m_past.end()) {
    const double ahead = std::min(toSeconds(instant - m_past.back().stamp), kMostAhead);
    return m_past.back().odometry * integrate(m_past.back().velocity, ahead);
  }
  const BaseState &before = *std::prev(after);
  const double share = toSeconds(instant - before.stamp) / toSeconds(after->stamp - before.stamp);
  const Pose2 step = before.odometry.inverse() * after->odometry;
  return before.odometry * Pose2{share * step.x, share * step.y, share * step.heading};
}

std::string Motion::silentDevice() const
{
  const Time now = m_devices.clock.now();
  const auto silent = [now](Time heard, double most) { return toSeconds(now - heard) > most; };
  if (silent(m_sight.base.stamp, m_options.baseSilence)) {
    return "base";
  }
  if (!m_laserSpoke || silent(*m_laserSpoke, m_options.laserSilence)) {
    return "laser";
  }
  const std::optional<Time> picture = m_devices.camera.newest();
  return picture && silent(*picture, m_options.cameraSilence) ? "camera" : "";
}

void Motion::look()
{
  try {
    see();
  }
  catch (const RuntimeError &) {
    m_devices.base.drive({});
    throw;
  }
}

void Motion::see()
{
  const Eigen::Vector2d before = pose().translation();
  read();
  const Time begin = m_devices.clock.now();
  for (std::string silent = silentDevice(); !silent.empty(); silent = silentDevice()) {
    m_devices.base.drive({});
    if (m_stop) {
      throw StopRequested{};
    }
    if (toSeconds(m_devices.clock.now() - begin) > m_options.lostSeconds) {
      throw DeviceError("the " + silent + " has been silent for more than " +
                        std::to_string(std::lround(m_options.lostSeconds)) + " s; check its link");
    }
    read();
  }
  if (m_looked) {
    m_travelled += (pose().translation() - before).norm();
  }
  m_looked = true;
  checkBumpers();
  const Pose2 oMr = poseAt(m_sight.scan->stamp);
  if (m_witness.contradicts(*m_sight.scan, oMr)) {
    throw DeviceError("the laser sees the room turn the other way than the wheels; it is mounted "
                      "upside down, or left and right wheels are exchanged");
  }
  m_memory.update(*m_sight.scan, m_rMl, oMr);
  m_memory.update(m_sight.base.sonar, pose(), m_devices.clock.now());
  m_sight.points = m_memory.points(pose());
}

const Motion::Sight &Motion::tick()
{
  if (m_stop) {
    stop();
    throw StopRequested{};
  }
  look();
  m_trail.add(pose());
  if (isHeld()) {
    backOff();
  }
  return m_sight;
}

void Motion::checkBumpers()
{
  const BaseState &base = m_sight.base;
  if (!base.bumpedAhead && !base.bumpedBehind) {
    m_pressedAt.reset();
    return;
  }
  if (!m_pressedAt) {
    m_pressedAt = pose().translation();
  }
  if ((pose().translation() - *m_pressedAt).norm() > m_options.bumperReach) {
    throw DeviceError(std::string("the ") + (base.bumpedAhead ? "front" : "rear") +
                      " bumper stays pressed wherever the robot goes; free it, or check its wires");
  }
}

bool Motion::isHeld() const
{
  return m_sight.base.stalled || m_sight.base.bumpedAhead || m_sight.base.bumpedBehind;
}

void Motion::backOff()
{
  constexpr double kSpeed = 0.15; // m/s
  constexpr double kRate = 0.4;   // rad/s
  constexpr int kTicks = 8;
  constexpr double kStraight = 0.01; // m/s; below it turns on the spot
  m_devices.base.drive({});
  m_felt = pose().translation();
  const bool turning = std::abs(m_commanded.v) < kStraight && m_commanded.w != 0.0;
  believeInContact();
  // Where it stood a moment ago it was free.
  const Twist2 undo{-std::clamp(m_commanded.v, -kSpeed, kSpeed),
                    -std::clamp(m_commanded.w, -kRate, kRate)};
  for (int i = 0; i < kTicks && !m_stop; ++i) {
    command(undo);
    look();
  }
  if (m_sight.base.bumpedBehind) {
    stop(); // the way it came is the one that is barred
    return;
  }
  if (!retrace(m_options.retreat) && turning) {
    sidle();
  }
}

/** Creeps straight to where there is more room: what holds a corner in both turns lets it go on
 * along its side. */
void Motion::sidle()
{
  constexpr double kDistance = 0.15; // metres
  constexpr double kLeast = 0.03;    // metres that were worth while
  constexpr double kAhead = 0.5;     // metres looked at
  constexpr int kTicks = 60;
  constexpr int kStartTicks = 5; // a stall reported before is the old one
  const auto room = [this](double v) {
    return freeTravel(m_memory.sensed(pose()), m_footprint, {v, 0.0}, kAhead);
  };
  const double first = room(1.0) < room(-1.0) ? -1.0 : 1.0;
  for (const double way : {first, -first}) {
    const double begin = m_travelled;
    for (int i = 0; i < kTicks && !m_stop && m_travelled - begin < kDistance &&
                    room(way) > kLeast && (i <= kStartTicks || !isHeld());
         ++i) {
      venture({way * m_options.creep.speed, 0.0});
      look();
    }
    stop();
    if (m_travelled - begin > kLeast) {
      return;
    }
  }
}

void Motion::believeInContact()
{
  constexpr double kBeside = 0.02; // metres outside the body
  const Time now = m_devices.clock.now();
  const auto believe = [&](double x, double y) {
    m_memory.addContact(pose() * Eigen::Vector2d(x, y), now);
  };
  // What holds the robot is unseen: believe in a wall across its middle, where the mast stands.
  const auto believeInWall = [&](double x) {
    for (double y = -0.15; y <= 0.151; y += 0.05) {
      believe(x, y);
    }
  };
  const double ahead = m_footprint.xMax + kBeside;
  const double behind = m_footprint.xMin - kBeside;
  if (m_sight.base.bumpedAhead || m_sight.base.bumpedBehind) {
    if (m_sight.base.bumpedAhead) {
      believeInWall(ahead);
    }
    if (m_sight.base.bumpedBehind) {
      believeInWall(behind);
    }
    return;
  }
  if (m_commanded.v == 0.0) {
    // Turning, the corners sweep: one ahead or the one across from it was held.
    const double side = m_commanded.w > 0.0 ? 1.0 : -1.0;
    const double y = side > 0.0 ? m_footprint.yMax + kBeside : m_footprint.yMin - kBeside;
    const double across = side > 0.0 ? m_footprint.yMin - kBeside : m_footprint.yMax + kBeside;
    believe(m_footprint.xMax, y);
    believe(m_footprint.xMin, across);
    return;
  }
  believeInWall(m_commanded.v > 0.0 ? ahead : behind);
}

bool Motion::retrace(double distance)
{
  constexpr int kTicks = 120;
  constexpr double kAhead = 0.08; // metres or radians that must be free, ...
  constexpr double kLeast = 0.05; // ... and that make it worth while
  constexpr int kStartTicks = 5;  // a stall reported before is the old one
  stop();
  const double begin = m_travelled;
  for (int i = 0; i < kTicks && m_travelled - begin < distance && !m_stop; ++i) {
    const auto twist = m_trail.wayBack(pose());
    if (!twist || freeTravel(m_memory.sensed(pose()), m_footprint, *twist, kAhead) < kLeast ||
        m_sight.base.bumpedBehind || (i > kStartTicks && isHeld())) {
      break;
    }
    command(*twist);
    look();
  }
  stop();
  const bool moved = m_travelled - begin > kLeast;
  if (!moved) {
    // What was believed of contacts leaves no way: it was a guess.
    m_memory.forgetContacts();
    m_sight.points = m_memory.points(pose());
  }
  return moved;
}

bool Motion::backOut(double distance)
{
  constexpr double kSpeed = 0.1;  // m/s
  constexpr double kBehind = 2.5; // radians; sonars from there on look back
  constexpr double kAhead = 0.2;  // metres that must be free behind, ...
  constexpr double kLeast = 0.12; // ... and that make it worth while
  constexpr int kTicks = 60;
  stop();
  const auto &sonar = m_sight.base.sonar;
  if (std::none_of(sonar.begin(), sonar.end(), [](const SonarEcho &echo) {
        return std::abs(wrapAngle(echo.bearing)) > kBehind;
      })) {
    return false;
  }
  const Twist2 back{-kSpeed, 0.0};
  const double begin = m_travelled;
  for (int i = 0; i < kTicks && m_travelled - begin < distance && !m_stop && !isHeld() &&
                  freeTravel(m_memory.sensed(pose()), m_footprint, back, kAhead) > kLeast;
       ++i) {
    venture(back);
    look();
  }
  stop();
  return m_travelled - begin > 0.5 * kLeast;
}

/** Commands a twist, but never on against a bumper that is pressed. */
void Motion::command(const Twist2 &twist)
{
  const BaseState &base = m_sight.base;
  m_commanded = {std::clamp(twist.v, base.bumpedBehind ? 0.0 : -kUnlimited,
                            base.bumpedAhead ? 0.0 : kUnlimited),
                 twist.w};
  m_devices.base.drive(m_commanded);
}

/** Commands a twist over ground the robot has not just come over: gently where what stands unseen
 * beside it was felt. */
void Motion::venture(const Twist2 &twist)
{
  const bool beside = m_felt && (pose().translation() - *m_felt).norm() < m_options.feltReach;
  command(beside ? slowed(twist, m_footprint, m_options.creep.speed) : twist);
}

/** Commands a twist, gently past what is near. */
void Motion::go(const Twist2 &twist)
{
  venture(creep(m_sight.points, m_footprint, twist, m_options.creep));
}

void Motion::stop()
{
  constexpr int kTicks = 20;
  for (int i = 0; i < kTicks; ++i) {
    command({});
    look();
    if (std::abs(m_sight.base.velocity.v) < 0.01 && std::abs(m_sight.base.velocity.w) < 0.02) {
      return;
    }
  }
}

LocalDrive::State Motion::steer(double bearing, double speed, Room room)
{
  const Time now = m_devices.clock.now();
  LocalDrive::Decision decision;
  if (now >= m_tightUntil) {
    decision = m_localDrive.choose(m_sight.points, bearing, speed);
    const bool allowed =
        room == Room::Tight || clearance(m_sight.points, m_footprint) < m_options.minMargin;
    if (decision.state == LocalDrive::State::Blocked && allowed) {
      m_tightUntil = now + fromSeconds(m_options.tightSeconds);
    }
  }
  if (now < m_tightUntil) {
    decision = m_tightDrive.choose(m_sight.points, bearing, std::min(speed, m_options.tightSpeed));
  }
  go(decision.twist);
  return decision.state;
}

LocalDrive::State Motion::follow(const Twist2 &twist, double bearing)
{
  if (twist.v > 0.01) {
    // Where there is less room, LocalDrive weighs how much of it to keep.
    AvoidOptions roomy = m_safety;
    roomy.margin = m_options.margin;
    const Twist2 safe = avoid(m_sight.points, m_footprint, twist, roomy);
    if (safe.v > 0.3 * twist.v && clearance(m_sight.points, m_footprint) > m_options.margin) {
      go(safe);
      return LocalDrive::State::Free;
    }
  }
  return steer(bearing, std::max(twist.v, 0.15), Room::Tight);
}

bool Motion::turnIsFree(double angle) const
{
  constexpr double kSlack = 0.05;
  const double travel =
      freeTravel(m_sight.points, m_footprint, {0.0, angle > 0.0 ? 1.0 : -1.0}, std::abs(angle));
  return travel > std::abs(angle) - kSlack;
}

void Motion::turn(double rate)
{
  go(avoid(m_sight.points, m_footprint, {0.0, rate}, m_safety));
}

bool Motion::turnTo(double oHeading)
{
  constexpr double kClose = 0.03;
  constexpr int kTicks = 400;
  constexpr int kRetreats = 2;
  int direction = 0;
  int retreats = 0;
  for (int i = 0; i < kTicks; ++i) {
    const double error = wrapAngle(oHeading - pose().heading);
    if (std::abs(error) < kClose) {
      stop();
      return true;
    }
    double way = error;
    if (std::abs(error) > radians(20.0)) {
      const double longWay = error > 0.0 ? error - 2.0 * kPi : error + 2.0 * kPi;
      if (direction == 0 && !turnIsFree(error)) {
        direction = turnIsFree(longWay) ? (longWay > 0.0 ? 1 : -1) : 0;
        if (direction == 0) {
          if (retreats++ == kRetreats || !retrace(m_options.retreat)) {
            stop();
            return false;
          }
          continue;
        }
      }
      way = direction != 0 && direction * error < 0.0 ? longWay : error;
    }
    const double rate = std::clamp(1.5 * std::abs(way), 0.08, m_options.maxTurnRate);
    turn(std::copysign(rate, way));
    tick();
  }
  stop();
  return false;
}

} // namespace homeward
