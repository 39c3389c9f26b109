// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/laser/safety.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
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

/** Metres free straight on (or back) after a turn on the spot; negative when the turn touches. */
double afterTurn(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
                 double turn, double direction)
{
  constexpr double kLookAhead = 1.0;
  const double size = std::abs(turn);
  if (freeTravel(points, footprint, {0.0, turn}, size) < size) {
    return -1.0;
  }
  const Pose2 turned = Pose2{0.0, 0.0, turn}.inverse();
  std::vector<Eigen::Vector2d> seen;
  seen.reserve(points.size());
  for (const Eigen::Vector2d &p : points) {
    seen.push_back(turned * p);
  }
  return freeTravel(seen, footprint, {direction, 0.0}, kLookAhead);
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
    const double free = freeTravel(points, footprint, wanted, 2.0 * kPi);
    return slowed(wanted, stoppableSpeed(free, options.turnDeceleration, options.reaction));
  }
  const double enough = options.nearDistance + std::abs(wanted.v) * options.reaction +
                        wanted.v * wanted.v / (2.0 * options.deceleration);
  const double free = freeTravel(points, footprint, wanted, enough);
  if (free >= options.nearDistance) {
    return slowed(wanted, stoppableSpeed(free, options.deceleration, options.reaction));
  }
  const double direction = wanted.v > 0.0 ? 1.0 : -1.0;
  const double left = afterTurn(points, footprint, options.turnAngle, direction);
  const double right = afterTurn(points, footprint, -options.turnAngle, direction);
  if (left < 0.0 && right < 0.0) {
    return {};
  }
  const bool toLeft = left != right ? left > right : wanted.w >= 0.0;
  return {0.0, toLeft ? options.turnRate : -options.turnRate};
}

} // namespace homeward
