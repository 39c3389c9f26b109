// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/random.h>
#include <homeward/core/time.h>
#include <homeward/robot/rig.h>
#include <homeward/sim/collision_map.h>

#include <memory>
#include <optional>
#include <vector>

namespace homeward
{

/**
 * How far wheels and floor disagree. The encoders count the wheels' turning, not what slips, so
 * all of it becomes drift of the odometry. Each slip is a constant drawn from the seed plus a
 * part that wanders with a time constant of 5 s, both with the standard deviation given.
 */
struct DriveErrors
{
  double forwardSlip = 0.008; ///< share of the distance, standard deviation
  double turnSlip = 0.03;     ///< share of the turn (skidding wheels slip more), standard deviation
  double veer = 0.006;        ///< turn for a metre driven, radians, standard deviation
};

/** Counts the times that the body has run into something. */
class ContactCounter
{
public:
  /**
   * One step of the world.
   * @param contacts what the body would touch; empty when it moves freely
   * @param twist of the body, for the speed of the point that touches
   */
  void observe(Time now, const Pose2 &wMr, const Twist2 &twist,
               const std::vector<Contact> &contacts);

  /** See Truth. */
  int collisions() const { return m_collisions; }
  /** See Truth. */
  int unseenContacts() const { return m_unseenContacts; }

private:
  int m_collisions = 0;
  int m_unseenContacts = 0;
  std::optional<Pose2> m_event; ///< where the contact that lasts was counted
  Time m_lastContact{};
};

/**
 * A skid-steered base: reaches the commanded velocity with limited acceleration, slips, and stands
 * still where the next step would make its body touch something.
 */
class WheeledBase
{
public:
  /** Without a command for so long it stops, as the Pioneer's controller does. */
  static constexpr Duration kWatchdog = std::chrono::milliseconds(600);

  /** Stands at `start`, in the world frame. @param seed of its slip */
  WheeledBase(std::shared_ptr<const CollisionMap> map, const Limits &limits,
              const DriveErrors &errors, std::uint64_t seed, const Pose2 &start);

  /** Sets the velocity to reach; clamped to the limits. @throw LogicError unless it is finite */
  void command(Time now, const Twist2 &twist);

  /**
   * From now on the body meets another world.
   * @param things that come and go in it; null when there are none
   */
  void meet(std::shared_ptr<const CollisionMap> map, std::shared_ptr<const CollisionMap> things);

  /** Moves the world on from `now` by `step`. */
  void step(Time now, Duration step);

  /** Puts the robot elsewhere, standing still; its odometry does not notice. */
  void place(const Pose2 &wMr);

  /** True pose in the world. */
  const Pose2 &pose() const { return m_pose; }
  /** As its encoders have it. */
  const Pose2 &odometry() const { return m_odometry; }
  const Twist2 &velocity() const { return m_velocity; } ///< of the wheels
  /** Commanded to move, and held. */
  bool stalled() const { return m_stalled; }
  double distance() const { return m_distance; } ///< truly driven, metres
  /** What the body has run into so far. */
  const ContactCounter &contacts() const { return m_contacts; }

private:
  /** A value that wanders about a mean. */
  struct Wander
  {
    double mean = 0.0;
    double sigma = 0.0;
    double offset = 0.0;

    double next(double seconds, Random &random);
  };

  std::vector<Contact> contactsAt(const Pose2 &wMr) const;
  Twist2 ramped(const Twist2 &wanted, double seconds) const;

  std::shared_ptr<const CollisionMap> m_map;
  std::shared_ptr<const CollisionMap> m_things; ///< null when there are none
  Limits m_limits;
  Random m_random;
  Wander m_forwardSlip;
  Wander m_turnSlip;
  Wander m_veer;
  Pose2 m_pose;
  Pose2 m_odometry;
  Twist2 m_velocity;
  Twist2 m_command;
  Time m_commanded{};
  bool m_stalled = false;
  double m_distance = 0.0;
  ContactCounter m_contacts;
};

} // namespace homeward
