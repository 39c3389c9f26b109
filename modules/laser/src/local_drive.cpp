// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/laser/local_drive.h>

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
  require(o.minMargin >= 0.0, "minMargin", o.minMargin, "0 or more");
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
  const Footprint grown = m_footprint.grown(m_options.minMargin);
  const double full = 2.0 * kPi;
  const auto turn = [&](double w) {
    return std::min(freeTravel(around.points, grown, {0.0, w}, full, m_options.minMargin),
                    freeTravel(around.points, m_footprint, {0.0, w}, full));
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
                             double horizon) const
{
  const Footprint grown = m_footprint.grown(m_options.minMargin);
  const Twist2 arc{1.0, curvature};
  const double length = std::min(horizon, std::abs(turn / curvature));
  const double bend = std::min(freeTravel(around.points, grown, arc, length, m_options.minMargin),
                               freeTravel(around.points, m_footprint, arc, length));
  if (bend < length) {
    return bend;
  }
  return length + freeTravel(seenFrom(around.points, integrate(arc, length)), grown, {1.0, 0.0},
                             horizon - length, m_options.minMargin);
}

LocalDrive::Way LocalDrive::score(const Surroundings &around, double turn, double deflection) const
{
  // Margins and what they weigh: what must be, what is preferred, what is comfortable.
  const std::array<std::array<double, 2>, 3> margins{
      {{m_options.minMargin, 1.0}, {m_options.margin, 0.5}, {2.5 * m_options.margin, 0.25}}};
  constexpr double kSum = 1.75;
  Way way{turn, deflection, 0.0, 0.0, spotTurn(around, turn)};
  const std::vector<Eigen::Vector2d> seen = seenFrom(around.points, {0.0, 0.0, turn});
  for (const auto &[margin, weight] : margins) {
    const double travel =
        freeTravel(seen, m_footprint.grown(margin), {1.0, 0.0}, around.horizon, margin);
    way.travel = margin == m_options.minMargin ? travel : way.travel;
    way.score += weight / kSum * travel / around.horizon;
  }
  way.travel = std::min(way.travel, freeTravel(seen, m_footprint, {1.0, 0.0}, around.horizon));
  way.score *= 1.0 - 0.6 * std::abs(deflection) / (kPi / 2.0);
  way.score -= m_options.turnCost * std::abs(way.spot.value_or(turn));
  return way;
}

std::optional<LocalDrive::Way> LocalDrive::best(const Surroundings &around, double bearing) const
{
  constexpr double kReachable = radians(60.0);
  std::optional<Way> best;
  const int steps = static_cast<int>(m_options.maxDeflection / kStep + 1e-9);
  for (int k = 0; k <= 2 * steps; ++k) {
    // 0, +1, -1, +2, ...: of equal ways the least deflected, then the left one, is kept.
    const double deflection = kStep * ((k + 1) / 2) * (k % 2 == 1 ? 1.0 : -1.0);
    const double turn = wrapAngle(bearing + deflection);
    const Way way = score(around, turn, deflection);
    if (way.travel < m_options.minTravel || (best && way.score <= best->score)) {
      continue;
    }
    if (way.spot || (std::abs(turn) < kReachable && alongArc(around, way, m_options.maxSpeed))) {
      best = way;
    }
  }
  return best;
}

std::optional<Twist2> LocalDrive::alongArc(const Surroundings &around, const Way &way,
                                           double speed) const
{
  constexpr std::array<double, 3> kLengths{0.6, 0.35, 0.15}; // metres of bend, gentlest first
  constexpr double kMostCurved = 5.0;                        // 1/m; tighter is turning on the spot
  constexpr double kShare = 0.85; // of what the direction promises, that an arc must keep
  const double slow = 0.1 + 2.0 * around.clearance;
  for (const double length : kLengths) {
    const bool straight = std::abs(way.turn) < kStraight;
    const double curvature = straight ? 0.0 : way.turn / length;
    if (std::abs(curvature) > kMostCurved) {
      continue;
    }
    const double travel =
        straight ? way.travel : arcTravel(around, curvature, way.turn, around.horizon);
    if (travel < std::max(m_options.minTravel, kShare * way.travel)) {
      continue;
    }
    const double v =
        std::min({speed, m_options.maxSpeed, slow,
                  stoppableSpeed(travel - m_options.safety.nearDistance / 2.0,
                                 m_options.safety.deceleration, m_options.safety.reaction),
                  straight ? speed : m_options.maxTurnRate / std::abs(curvature)});
    const Twist2 twist{v, v * curvature};
    const Twist2 safe = avoid(around.points, m_footprint, twist, m_options.safety);
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

LocalDrive::Decision LocalDrive::choose(const std::vector<Eigen::Vector2d> &points,
                                        double desiredBearing, double desiredSpeed) const
{
  require(std::isfinite(desiredBearing), "desiredBearing", desiredBearing, "finite");
  require(std::isfinite(desiredSpeed) && desiredSpeed >= 0.0, "desiredSpeed", desiredSpeed,
          "0 or more");
  const Surroundings around = look(points, desiredSpeed);
  const std::optional<Way> way = best(around, wrapAngle(desiredBearing));
  if (!way) {
    return {};
  }
  const State state = std::abs(way->deflection) < kStep / 2.0 ? State::Free : State::Deflected;
  if (std::abs(way->turn) <= m_options.turnFirst) {
    if (const auto twist = alongArc(around, *way, desiredSpeed)) {
      return {*twist, state};
    }
  }
  if (const auto twist = onTheSpot(around, *way)) {
    return {*twist, state};
  }
  return {};
}

} // namespace homeward
