// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/laser/safety.h>

#include "sweep.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace homeward
{
namespace
{

void requirePositive(const char *name, double value)
{
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw LogicError(std::string("avoid: ") + name + " is " + std::to_string(value) +
                     ", must be above 0");
  }
}

void check(const AvoidOptions &options)
{
  requirePositive("nearDistance", options.nearDistance);
  requirePositive("turnAngle", options.turnAngle);
  requirePositive("turnRate", options.turnRate);
  requirePositive("deceleration", options.deceleration);
  requirePositive("turnDeceleration", options.turnDeceleration);
  if (!(options.margin >= 0.0)) {
    throw LogicError("avoid: margin is " + std::to_string(options.margin) +
                     " m, must not be negative");
  }
  if (!(options.reaction >= 0.0)) {
    throw LogicError("avoid: reaction is " + std::to_string(options.reaction) +
                     " s, must not be negative");
  }
}

/** The same arc, no faster than `limit` in metres, or radians for a turn, per second. */
Twist2 slowed(const Twist2 &twist, double limit)
{
  const double speed = twist.v != 0.0 ? std::abs(twist.v) : std::abs(twist.w);
  const double share = std::min(1.0, limit / speed);
  return {twist.v * share, twist.w * share};
}

/** Whether the robot, turned on the spot, has the near distance free straight on (or back). */
bool freeWhenTurned(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
                    double turn, double direction, double margin, double distance)
{
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  return std::none_of(points.begin(), points.end(), [&](const Eigen::Vector2d &p) {
    const double x = c * p.x() + s * p.y();
    const double y = c * p.y() - s * p.x();
    return straightTravel(footprint.grown(margin), x, y, direction, inside(margin)) < distance;
  });
}

/** The least turn to one side, rad, after which the way is free; nothing when it is out of reach.
 */
std::optional<double> turnAway(const std::vector<Eigen::Vector2d> &points,
                               const Footprint &footprint, double side, double direction,
                               const AvoidOptions &options)
{
  constexpr double kStep = radians(2.5);
  const double room = guardedTravel(points, footprint, options.margin, {0.0, side}, kPi);
  for (double turn = options.turnAngle; turn <= room; turn += kStep) {
    if (freeWhenTurned(points, footprint, side * turn, direction, options.margin,
                       options.nearDistance)) {
      return turn;
    }
  }
  return std::nullopt;
}

} // namespace

double stoppableSpeed(double distance, double deceleration, double reaction)
{
  if (distance <= 0.0) {
    return 0.0;
  }
  const double lost = deceleration * reaction;
  return std::sqrt(lost * lost + 2.0 * deceleration * distance) - lost;
}

Twist2 avoid(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
             const Twist2 &wanted, const AvoidOptions &options)
{
  check(options);
  if (!std::isfinite(wanted.v) || !std::isfinite(wanted.w)) {
    throw LogicError("avoid: the twist wanted is not finite");
  }
  if (wanted.v == 0.0) {
    if (wanted.w == 0.0) {
      return wanted;
    }
    const double free = guardedTravel(points, footprint, options.margin, wanted, 2.0 * kPi);
    return slowed(wanted, stoppableSpeed(free, options.turnDeceleration, options.reaction));
  }
  const double enough = options.nearDistance + std::abs(wanted.v) * options.reaction +
                        wanted.v * wanted.v / (2.0 * options.deceleration);
  const double free = guardedTravel(points, footprint, options.margin, wanted, enough);
  if (free >= options.nearDistance) {
    return slowed(wanted, stoppableSpeed(free, options.deceleration, options.reaction));
  }
  const double direction = wanted.v > 0.0 ? 1.0 : -1.0;
  const auto left = turnAway(points, footprint, 1.0, direction, options);
  const auto right = turnAway(points, footprint, -1.0, direction, options);
  if (!left && !right) {
    return {};
  }
  const double gain = right.value_or(2.0 * kPi) - left.value_or(2.0 * kPi);
  const bool toLeft = gain != 0.0 ? gain > 0.0 : wanted.w >= 0.0;
  return {0.0, toLeft ? options.turnRate : -options.turnRate};
}

Twist2 creep(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
             const Twist2 &wanted, const CreepOptions &options)
{
  if (!(options.speed > 0.0)) {
    throw LogicError("creep: speed is " + std::to_string(options.speed) + " m/s, must be above 0");
  }
  const Pose2 soonMr = integrate(wanted, options.ahead).inverse();
  double fastest = options.speed;
  for (const Eigen::Vector2d &now : points) {
    for (const Eigen::Vector2d &point : {now, Eigen::Vector2d(soonMr * now)}) {
      const Eigen::Vector2d beside(std::clamp(point.x(), footprint.xMin, footprint.xMax),
                                   std::clamp(point.y(), footprint.yMin, footprint.yMax));
      if ((point - beside).norm() < options.near) {
        fastest =
            std::max(fastest, std::hypot(wanted.v - wanted.w * beside.y(), wanted.w * beside.x()));
      }
    }
  }
  return {wanted.v * options.speed / fastest, wanted.w * options.speed / fastest};
}

} // namespace homeward
