// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/laser/local_drive.h>
#include <homeward/pilot/obstacle_memory.h>
#include <homeward/pilot/trail.h>
#include <homeward/pilot/turn_calibration.h>
#include <homeward/pilot/turn_witness.h>
#include <homeward/robot/clock.h>
#include <homeward/robot/image_source.h>
#include <homeward/robot/laser_scanner.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/robot/robot_description.h>

#include <atomic>
#include <deque>
#include <optional>
#include <string>

namespace homeward
{

/** The robot's devices; whoever owns them outlives their users. */
struct Devices
{
  Clock &clock;        ///< robot time
  MobileBase &base;    ///< wheels
  LaserScanner &laser; ///< ranges
  ImageSource &camera; ///< mirror pictures
};

/** Settings of the control loop. */
struct MotionOptions
{
  double tickSeconds = 0.1;   ///< of the control loop
  double baseSilence = 0.3;   ///< s without news of the base: the robot waits, standing
  double laserSilence = 0.3;  ///< s without a scan that says anything, likewise
  double cameraSilence = 0.5; ///< s without a picture, likewise, of a camera that runs by itself
  double lostSeconds = 5.0;   ///< s of waiting after which a silent device is lost
  double maxSpeed = 0.5;      ///< m/s
  double maxTurnRate = 1.0;   ///< rad/s
  double margin = 0.10;       ///< metres preferred round the body
  double minMargin = 0.08;    ///< metres kept round it in any case: furniture is wider lower down
  double tightMargin = 0.03;  ///< metres kept where there is no other way, ...
  double tightSpeed = 0.15;   ///< m/s, ... driven slowly
  double tightSeconds = 3.0;  ///< s it goes on so, lest it turns to and fro
  CreepOptions creep;         ///< how slowly it passes what is near
  double feltReach = 0.3;     ///< metres from where something was felt that it creeps all the same
  double bumperReach = 0.2;   ///< metres from where it was pressed at which a bumper is stuck
  double retreat = 0.3;       ///< metres driven back along the way it came after a contact
  ObstacleMemory::Options memory; ///< of obstacles out of sight
};

/** Thrown inside the pilot when somebody asks the robot to stop; the robot stands when it arrives.
 */
struct StopRequested
{};

/**
 * The fast half of the pilot: one tick reads base and laser, remembers obstacles near by, and
 * whatever is asked for goes to the wheels only as far as it is safe. Never waits for perception.
 */
class Motion
{
public:
  /** What a tick saw. */
  struct Sight
  {
    BaseState base;                      ///< newest
    std::optional<Scan> scan;            ///< newest, laser frame
    std::vector<Eigen::Vector2d> points; ///< obstacles near by, robot frame, metres
  };

  /** @param stop set by anybody at any time: the next tick stops the robot and throws StopRequested
   */
  Motion(const Devices &devices, const RobotDescription &robot, const MotionOptions &options,
         const std::atomic<bool> &stop);

  /** Stops the robot. */
  ~Motion();
  Motion(const Motion &) = delete;
  Motion &operator=(const Motion &) = delete;

  /**
   * Waits for the next tick and looks. While a device is silent the robot stands and the tick
   * waits for it. Frees the robot first when something holds it or a bumper is pressed.
   * @throw DeviceError when a device is gone or does not come back, the laser runs the wrong way
   * round, a bumper is stuck or the base is halted, StopRequested; the robot stands in all cases
   */
  const Sight &tick();

  /** What the last tick saw. */
  const Sight &sight() const { return m_sight; }
  /** By odometry, as far as it has been learnt how much turns skid. */
  const Pose2 &pose() const { return m_sight.base.odometry; }

  /** Where the robot was, or will be if it goes on so, odometry frame; a few seconds back. */
  Pose2 poseAt(Time instant) const;

  /** Metres driven so far, along the path. */
  double travelled() const { return m_travelled; }

  /** See TurnCalibration. */
  double turned() const { return m_turns.turned(); }
  /** Takes what a view says was lost or gained in `turned`, radians. See TurnCalibration. */
  bool learnTurns(double turned, double missing) { return m_turns.learn(turned, missing); }

  /** How narrow a way may be. */
  enum class Room
  {
    Ample, ///< not driven before: it may be narrower than the laser sees
    Tight  ///< leads to a place known to be reached
  };

  /**
   * Drives towards a bearing for one tick, round what is in the way. Out of a place that is tight
   * already a tight way is taken too.
   * @param bearing radians in the robot's frame
   * @param speed m/s
   */
  LocalDrive::State steer(double bearing, double speed, Room room);

  /**
   * Drives a twist for one tick when its arc is free, else steers towards the bearing that it
   * serves.
   * @param bearing radians in the robot's frame
   */
  LocalDrive::State follow(const Twist2 &twist, double bearing);

  /** Turns on the spot for one tick, as far as there is room. @param rate rad/s, left positive */
  void turn(double rate);

  /** Turns on the spot to a heading of the odometry frame, backing out first of where there is no
   * room to. @return false when there still is none */
  bool turnTo(double oHeading);

  /**
   * Drives back along the way it came, which was free, out of where no way leads on.
   * @param distance metres along the way
   * @return whether the robot has moved
   */
  bool retrace(double distance);

  /**
   * Drives slowly straight back, as far as sonars that look there hear nothing: out of where it was
   * put and can neither turn nor go on.
   * @return whether the robot has moved; not without such sonars
   */
  bool backOut(double distance);

  /** Asks for zero velocity, for one tick. */
  void hold() { command({}); }

  /** Zero velocity; returns when the robot stands. */
  void stop();

  /** What it drives with. */
  Devices &devices() { return m_devices; }

private:
  void look(); ///< sees; whatever goes wrong, the zero command goes first
  void see();
  void read();
  std::string silentDevice() const;
  void checkBumpers();
  bool isHeld() const;
  void backOff();
  void sidle();
  void believeInContact();
  void command(const Twist2 &twist);
  void venture(const Twist2 &twist);
  void go(const Twist2 &twist);
  bool turnIsFree(double angle) const;

  Devices m_devices;
  MotionOptions m_options;
  const std::atomic<bool> &m_stop;
  Footprint m_footprint;
  Pose2 m_rMl;
  AvoidOptions m_safety;
  LocalDrive m_localDrive;
  LocalDrive m_tightDrive;
  ObstacleMemory m_memory;
  Trail m_trail;
  TurnCalibration m_turns;
  TurnWitness m_witness;
  std::optional<Time> m_laserSpoke;           ///< when the last scan was taken that says enough
  std::optional<Eigen::Vector2d> m_pressedAt; ///< where it stood when a bumper was, odometry frame
  Twist2 m_commanded;                         ///< last
  std::optional<Eigen::Vector2d> m_felt; ///< where it last stood when it was held, odometry frame
  Sight m_sight;
  std::deque<BaseState> m_past; ///< a few seconds, oldest first
  Time m_nextTick;
  Time m_tightUntil{}; ///< tight ways are taken until then
  double m_travelled = 0.0;
  bool m_looked = false;
};

} // namespace homeward
