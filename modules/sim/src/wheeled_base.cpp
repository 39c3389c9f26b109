// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/wheeled_base.h>

#include "random_streams.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

constexpr double kWanderTime = 5.0;       // seconds
constexpr double kCollisionSpeed = 0.05;  // m/s
constexpr double kNewEventDistance = 0.1; // metres moved away
constexpr Duration kNewEventTime = std::chrono::seconds(1);

/** Speed of a point fixed to the body, m/s. */
double speedAt(const Eigen::Vector2d &point, const Pose2 &wMr, const Twist2 &twist)
{
  const Eigen::Vector2d arm = wMr.inverse() * point;
  return std::hypot(twist.v - twist.w * arm.y(), twist.w * arm.x());
}

/** `from` brought towards `to` by at most up (away from zero) or down (towards it). */
double ramp(double from, double to, double up, double down)
{
  const bool brakes = from * to < 0.0 || std::abs(to) < std::abs(from);
  const double most = brakes ? down : up;
  const double reached = from + std::clamp(to - from, -most, most);
  // Braking through zero ends at zero: beyond it the wheels accelerate.
  return from * reached < 0.0 ? 0.0 : reached;
}

} // namespace

void ContactCounter::observe(Time now, const Pose2 &wMr, const Twist2 &twist,
                             const std::vector<Contact> &contacts)
{
  const bool movedAway =
      m_event && (m_event->translation() - wMr.translation()).norm() > kNewEventDistance;
  if (movedAway || (m_event && now - m_lastContact > kNewEventTime)) {
    m_event.reset();
  }
  if (contacts.empty()) {
    return;
  }
  m_lastContact = now;
  const bool fast = std::any_of(contacts.begin(), contacts.end(), [&](const Contact &contact) {
    return speedAt(contact.point, wMr, twist) > kCollisionSpeed;
  });
  if (m_event || !fast) {
    return;
  }
  m_event = wMr;
  const bool seen = std::any_of(contacts.begin(), contacts.end(),
                                [](const Contact &contact) { return contact.laserVisible; });
  ++(seen ? m_collisions : m_unseenContacts);
}

double WheeledBase::Wander::next(double seconds, Random &random)
{
  offset += -offset * seconds / kWanderTime +
            random.normal(sigma * std::sqrt(2.0 * seconds / kWanderTime));
  return mean + offset;
}

WheeledBase::WheeledBase(std::shared_ptr<const CollisionMap> map, const Limits &limits,
                         const DriveErrors &errors, std::uint64_t seed, const Pose2 &start)
    : m_map(std::move(map)), m_limits(limits),
      m_random(seed, static_cast<std::uint32_t>(RandomStream::Drive)), m_pose(start)
{
  const auto draw = [&](double sigma) {
    return Wander{m_random.normal(sigma), sigma, m_random.normal(sigma)};
  };
  m_forwardSlip = draw(errors.forwardSlip);
  m_turnSlip = draw(errors.turnSlip);
  m_veer = draw(errors.veer);
}

void WheeledBase::command(Time now, const Twist2 &twist)
{
  if (!std::isfinite(twist.v) || !std::isfinite(twist.w)) {
    throw LogicError("drive: the velocity must be finite, got v = " + std::to_string(twist.v) +
                     ", w = " + std::to_string(twist.w));
  }
  m_command = {std::clamp(twist.v, -m_limits.maxSpeed, m_limits.maxSpeed),
               std::clamp(twist.w, -m_limits.maxTurnRate, m_limits.maxTurnRate)};
  m_commanded = now;
}

Twist2 WheeledBase::ramped(const Twist2 &wanted, double seconds) const
{
  const double turn = m_limits.turnAcceleration * seconds;
  return {ramp(m_velocity.v, wanted.v, m_limits.acceleration * seconds,
               m_limits.deceleration * seconds),
          ramp(m_velocity.w, wanted.w, turn, turn)};
}

void WheeledBase::meet(std::shared_ptr<const CollisionMap> map,
                       std::shared_ptr<const CollisionMap> things)
{
  m_map = std::move(map);
  m_things = std::move(things);
}

std::vector<Contact> WheeledBase::contactsAt(const Pose2 &wMr) const
{
  std::vector<Contact> contacts = m_map->contacts(wMr);
  if (m_things) {
    const std::vector<Contact> more = m_things->contacts(wMr);
    contacts.insert(contacts.end(), more.begin(), more.end());
  }
  return contacts;
}

void WheeledBase::step(Time now, Duration step)
{
  const double seconds = toSeconds(step);
  if (now - m_commanded >= kWatchdog) {
    m_command = {};
  }
  m_velocity = ramped(m_command, seconds);
  const double forwardSlip = m_forwardSlip.next(seconds, m_random);
  const double turnSlip = m_turnSlip.next(seconds, m_random);
  const double veer = m_veer.next(seconds, m_random);
  const Twist2 real{m_velocity.v * (1.0 - forwardSlip),
                    m_velocity.w * (1.0 - turnSlip) + m_velocity.v * veer};
  m_stalled = false;
  std::vector<Contact> contacts;
  if (real.v != 0.0 || real.w != 0.0) {
    const Pose2 next = m_pose * integrate(real, seconds);
    contacts = contactsAt(next);
    if (contacts.empty()) {
      m_pose = next;
      m_odometry = m_odometry * integrate(m_velocity, seconds);
      m_distance += std::abs(real.v) * seconds;
    }
    else {
      m_velocity = {};
      m_stalled = m_command.v != 0.0 || m_command.w != 0.0;
    }
  }
  m_contacts.observe(now + step, m_pose, real, contacts);
}

void WheeledBase::place(const Pose2 &wMr)
{
  m_pose = wMr;
  m_velocity = {};
  m_command = {};
  m_stalled = false;
}

} // namespace homeward
