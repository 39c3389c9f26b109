// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/laser/local_drive.h>

#include "sweep.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace homeward
{
namespace
{

constexpr double kStep = radians(5.0); ///< between the directions looked at
constexpr double kStraight = 1e-3;     ///< rad; a smaller turn is none

void require(bool holds, const char *name, double value, const char *rule)
{
  if (!holds) {
    throw LogicError(std::string("LocalDrive: ") + name + " is " + std::to_string(value) +
                     ", must be " + rule);
  }
}

void check(const LocalDrive::Options &o)
{
  require(o.maxSpeed > 0.0, "maxSpeed", o.maxSpeed, "above 0");
  require(o.maxTurnRate > 0.0, "maxTurnRate", o.maxTurnRate, "above 0");
  require(o.minMargin >= o.safety.margin, "minMargin", o.minMargin,
          "at least the margin that avoid() keeps");
  require(o.margin >= o.minMargin, "margin", o.margin, "at least minMargin");
  require(o.minTravel > o.safety.nearDistance, "minTravel", o.minTravel,
          "above the distance that avoid() keeps free");
  require(o.maxDeflection >= 0.0 && o.maxDeflection <= kPi / 2.0, "maxDeflection", o.maxDeflection,
          "0 to pi / 2");
  require(o.turnFirst > 0.0, "turnFirst", o.turnFirst, "above 0");
  require(o.lookAhead > 0.0, "lookAhead", o.lookAhead, "above 0");
  require(o.minHorizon >= o.minTravel, "minHorizon", o.minHorizon, "at least minTravel");
  require(o.maxHorizon >= o.minHorizon, "maxHorizon", o.maxHorizon, "at least minHorizon");
  require(o.turnCost >= 0.0, "turnCost", o.turnCost, "0 or more");
}

std::vector<Eigen::Vector2d> seenFrom(const std::vector<Eigen::Vector2d> &points, const Pose2 &rMp)
{
  const double c = std::cos(rMp.heading);
  const double s = std::sin(rMp.heading);
  std::vector<Eigen::Vector2d> seen;
  seen.reserve(points.size());
  for (const Eigen::Vector2d &p : points) {
    const double x = p.x() - rMp.x;
    const double y = p.y() - rMp.y;
    seen.emplace_back(c * x + s * y, c * y - s * x);
  }
  return seen;
}

} // namespace

/** A direction and what speaks for it. */
struct LocalDrive::Way
{
  double turn = 0.0;       ///< rad to it, in [-pi, pi)
  double deflection = 0.0; ///< rad from the desired bearing
  double travel = 0.0;     ///< metres free with the least margin
  double easyTravel = 0.0; ///< metres free with the preferred margin
  double score = -1.0;
  std::optional<double> spot; ///< rad to turn on the spot, either way round; nothing: no room
};

/** What matters near by. */
struct LocalDrive::Surroundings
{
  std::vector<Eigen::Vector2d> points; ///< within reach, robot frame
  double horizon = 0.0;                ///< metres
  double freeLeft = 0.0;               ///< rad the robot can turn on the spot
  double freeRight = 0.0;              ///< rad, positive
  double clearance = 0.0;              ///< metres
};

LocalDrive::LocalDrive(const Footprint &footprint, const Options &options)
    : m_footprint(footprint), m_options(options)
{
  check(options);
  clearance({}, footprint); // refuses a footprint without area
}

LocalDrive::Surroundings LocalDrive::look(const std::vector<Eigen::Vector2d> &points,
                                          double desiredSpeed) const
{
  Surroundings around;
  around.horizon =
      std::clamp(m_options.lookAhead * desiredSpeed, m_options.minHorizon, m_options.maxHorizon);
  const double size = std::hypot(std::max(m_footprint.xMax, -m_footprint.xMin),
                                 std::max(m_footprint.yMax, -m_footprint.yMin));
  const double reach = around.horizon + size + 2.0 * m_options.margin;
  for (const Eigen::Vector2d &p : points) {
    if (p.squaredNorm() < reach * reach) {
      around.points.push_back(p);
    }
  }
  const auto turn = [&](double w) {
    return guardedTravel(around.points, m_footprint, m_options.minMargin, {0.0, w}, 2.0 * kPi);
  };
  around.freeLeft = turn(1.0);
  around.freeRight = turn(-1.0);
  around.clearance = clearance(around.points, m_footprint);
  return around;
}

std::optional<double> LocalDrive::spotTurn(const Surroundings &around, double turn) const
{
  const auto room = [&](double angle) {
    return std::abs(angle) <= (angle > 0.0 ? around.freeLeft : around.freeRight);
  };
  const double longWay = turn > 0.0 ? turn - 2.0 * kPi : turn + 2.0 * kPi;
  if (std::abs(turn) < kStraight || room(turn)) {
    return turn;
  }
  return room(longWay) ? std::optional(longWay) : std::nullopt;
}

double LocalDrive::arcTravel(const Surroundings &around, double curvature, double turn,
                             double margin) const
{
  const Twist2 arc{1.0, curvature};
  const double length = std::min(around.horizon, std::abs(turn / curvature));
  const double bend = guardedTravel(around.points, m_footprint, margin, arc, length);
  if (bend < length) {
    return bend;
  }
  return length + guardedTravel(seenFrom(around.points, integrate(arc, length)), m_footprint,
                                margin, {1.0, 0.0}, around.horizon - length);
}

LocalDrive::Way LocalDrive::score(const Surroundings &around, double turn, double deflection) const
{
  // Margins and what they weigh: none, what must be, what is preferred, what is comfortable.
  const std::array<double, 4> margins{0.0, m_options.minMargin, m_options.margin,
                                      2.0 * m_options.margin};
  constexpr std::array<double, 4> kWeights{0.0, 0.3, 0.4, 0.3};
  std::array<double, 4> travels{};
  travels.fill(around.horizon);
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  const Footprint widest = m_footprint.grown(margins.back());
  for (const Eigen::Vector2d &p : around.points) {
    const double y = c * p.y() - s * p.x();
    if (y <= widest.yMin || y >= widest.yMax) {
      continue;
    }
    const double x = c * p.x() + s * p.y();
    for (std::size_t i = 0; i < margins.size(); ++i) {
      const double travel =
          straightTravel(m_footprint.grown(margins[i]), x, y, 1.0, inside(margins[i]));
      travels[i] = std::min(travels[i], travel);
    }
  }
  Way way{turn,       deflection, std::min(travels[0], travels[1]),
          travels[2], 0.0,        spotTurn(around, turn)};
  for (std::size_t i = 0; i < margins.size(); ++i) {
    way.score += kWeights[i] * travels[i] / around.horizon;
  }
  way.score *= 1.0 - 0.6 * std::abs(deflection) / (kPi / 2.0);
  way.score -= m_options.turnCost * std::abs(way.spot.value_or(turn));
  return way;
}

std::vector<LocalDrive::Way> LocalDrive::ways(const Surroundings &around, double bearing) const
{
  std::vector<Way> ways;
  const auto consider = [&](double deflection, double turn) {
    const Way way = score(around, turn, deflection);
    if (way.travel >= m_options.minTravel) {
      ways.push_back(way);
    }
  };
  const int steps = static_cast<int>(m_options.maxDeflection / kStep + 1e-9);
  for (int k = 0; k <= 2 * steps; ++k) {
    // 0, +1, -1, +2, ...: of equal ways the least deflected, then the left one, comes first.
    const double deflection = kStep * ((k + 1) / 2) * (k % 2 == 1 ? 1.0 : -1.0);
    consider(deflection, wrapAngle(bearing + deflection));
  }
  if (std::abs(bearing) <= m_options.maxDeflection + kStep) {
    consider(-bearing, 0.0); // straight on, which needs no room to turn
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Way &a, const Way &b) { return a.score > b.score; });
  return ways;
}

std::optional<Twist2> LocalDrive::alongArc(const Surroundings &around, const Way &way,
                                           double margin, double speed) const
{
  constexpr std::array<double, 3> kLengths{0.6, 0.35, 0.15}; // metres of bend, gentlest first
  constexpr double kMostCurved = 5.0;                        // 1/m; tighter is turning on the spot
  constexpr double kShare = 0.85; // of what the direction promises, that an arc must keep
  const double promised = margin > m_options.minMargin ? way.easyTravel : way.travel;
  const bool straight = std::abs(way.turn) < kStraight;
  const AvoidOptions &safety = m_options.safety;
  const double slow = 0.1 + 2.0 * around.clearance;
  for (const double length : kLengths) {
    const double curvature = straight ? 0.0 : way.turn / length;
    if (std::abs(curvature) > kMostCurved) {
      continue;
    }
    const double travel = straight ? promised : arcTravel(around, curvature, way.turn, margin);
    if (travel < std::max(m_options.minTravel, kShare * promised)) {
      continue;
    }
    const double stoppable =
        stoppableSpeed(travel - safety.nearDistance / 2.0, safety.deceleration, safety.reaction);
    const double v = std::min({speed, m_options.maxSpeed, slow, stoppable,
                               straight ? speed : m_options.maxTurnRate / std::abs(curvature)});
    const Twist2 safe = avoid(around.points, m_footprint, {v, v * curvature}, safety);
    if (safe.v > 0.0) {
      return safe;
    }
  }
  return std::nullopt;
}

std::optional<Twist2> LocalDrive::onTheSpot(const Surroundings &around, const Way &way) const
{
  constexpr double kGain = 2.0;     // 1/s
  constexpr double kSlowest = 0.15; // rad/s
  if (!way.spot || std::abs(*way.spot) < kStraight) {
    return std::nullopt;
  }
  const double rate =
      std::clamp(kGain * std::abs(*way.spot), kSlowest, std::max(kSlowest, m_options.maxTurnRate));
  const Twist2 safe =
      avoid(around.points, m_footprint, {0.0, std::copysign(rate, *way.spot)}, m_options.safety);
  return safe.w != 0.0 ? std::optional(safe) : std::nullopt;
}

std::optional<Twist2> LocalDrive::take(const Surroundings &around, const Way &way,
                                       double speed) const
{
  constexpr double kSmall = radians(20.0); // a smaller turn is not worth stopping for
  const double turn = std::abs(way.turn);
  std::optional<Twist2> twist;
  if (turn <= m_options.turnFirst) {
    twist = alongArc(around, way, m_options.margin, speed);
    if (!twist && turn <= kSmall) {
      twist = alongArc(around, way, m_options.minMargin, speed);
    }
  }
  if (!twist) {
    twist = onTheSpot(around, way);
  }
  if (!twist && turn > kSmall && turn <= m_options.turnFirst) {
    twist = alongArc(around, way, m_options.minMargin, speed);
  }
  return twist;
}

LocalDrive::Decision LocalDrive::choose(const std::vector<Eigen::Vector2d> &points,
                                        double desiredBearing, double desiredSpeed) const
{
  require(std::isfinite(desiredBearing), "desiredBearing", desiredBearing, "finite");
  require(std::isfinite(desiredSpeed) && desiredSpeed >= 0.0, "desiredSpeed", desiredSpeed,
          "0 or more");
  const Surroundings around = look(points, desiredSpeed);
  for (const Way &way : ways(around, wrapAngle(desiredBearing))) {
    if (const auto twist = take(around, way, desiredSpeed)) {
      const bool straight = std::abs(way.deflection) < kStep / 2.0;
      return {*twist, straight ? State::Free : State::Deflected};
    }
  }
  return {};
}

} // namespace homeward
