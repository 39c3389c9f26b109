// SPDX-License-Identifier: GPL-3.0-or-later
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

void check(const Footprint &f)
{
  if (!(f.xMin < f.xMax) || !(f.yMin < f.yMax)) {
    throw LogicError("footprint x " + std::to_string(f.xMin) + " to " + std::to_string(f.xMax) +
                     " m, y " + std::to_string(f.yMin) + " to " + std::to_string(f.yMax) +
                     " m has no area");
  }
}

bool inside(const Footprint &f, double x, double y)
{
  return x > f.xMin && x < f.xMax && y > f.yMin && y < f.yMax;
}

/** The rectangle as seen from the centre of the turn at (0, y). */
struct Turn
{
  Footprint footprint;
  double y;         ///< metres, centre on the robot's y axis
  double direction; ///< 1: the robot turns left, points go round clockwise
  double nearest2;  ///< squared distance from the centre to the rectangle
  double farthest2; ///< squared distance to its farthest corner
};

Turn turnAbout(const Footprint &f, double y, double direction)
{
  const double nearX = std::max({f.xMin, -f.xMax, 0.0});
  const double nearY = std::max({f.yMin - y, y - f.yMax, 0.0});
  const double farX = std::max(std::abs(f.xMin), std::abs(f.xMax));
  const double farY = std::max(std::abs(f.yMin - y), std::abs(f.yMax - y));
  return {f, y, direction, nearX * nearX + nearY * nearY, farX * farX + farY * farY};
}

/** Angles at which a point's circle crosses the rectangle's border, in [0, 2 pi). */
class Crossings
{
public:
  Crossings(const Turn &turn, const Eigen::Vector2d &q, double radius2)
  {
    const Footprint &f = turn.footprint;
    for (const double x : {f.xMin, f.xMax}) {
      if (const double rest = radius2 - x * x; rest >= 0.0) {
        const double y = std::sqrt(rest);
        for (const double side : {y, -y}) {
          if (side + turn.y >= f.yMin && side + turn.y <= f.yMax) {
            add(turn, q, {x, side});
          }
        }
      }
    }
    for (const double y : {f.yMin - turn.y, f.yMax - turn.y}) {
      if (const double rest = radius2 - y * y; rest >= 0.0) {
        const double x = std::sqrt(rest);
        for (const double side : {x, -x}) {
          if (side >= f.xMin && side <= f.xMax) {
            add(turn, q, {side, y});
          }
        }
      }
    }
    std::sort(m_angles.begin(), m_angles.begin() + m_count);
  }

  /** The n-th crossing; never when there are fewer. */
  double angle(std::ptrdiff_t n) const
  {
    return n < m_count ? m_angles[static_cast<std::size_t>(n)] : kNever;
  }

private:
  void add(const Turn &turn, const Eigen::Vector2d &q, const Eigen::Vector2d &at)
  {
    const double cross = at.x() * q.y() - at.y() * q.x();
    const double angle = std::atan2(turn.direction * cross, q.dot(at));
    m_angles[static_cast<std::size_t>(m_count++)] = angle < 0.0 ? angle + 2.0 * kPi : angle;
  }

  std::array<double, 8> m_angles{};
  std::ptrdiff_t m_count = 0;
};

/** Radians until a point is touched; what is no nearer than `most` may be answered as never. */
double turnTravel(const Turn &turn, const Eigen::Vector2d &p, double tolerance, double most)
{
  const Eigen::Vector2d q(p.x(), p.y() - turn.y);
  const double radius2 = q.squaredNorm();
  if (radius2 < turn.nearest2 || radius2 > turn.farthest2 ||
      squaredDistance(turn.footprint, p.x(), p.y()) > most * most * radius2) {
    return kNever;
  }
  if (!inside(turn.footprint, p.x(), p.y())) {
    return Crossings(turn, q, radius2).angle(0);
  }
  if (!ignorable(turn.footprint, p.x(), p.y(), turn.direction * q.y(), -turn.direction * q.x(),
                 tolerance)) {
    return 0.0;
  }
  // Back in after it has left, or deeper in than noise explains.
  const Turn core = turnAbout(turn.footprint.grown(-tolerance), turn.y, turn.direction);
  return std::min(Crossings(turn, q, radius2).angle(1), Crossings(core, q, radius2).angle(0));
}

} // namespace

double clearance(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint)
{
  check(footprint);
  double nearest2 = kNever;
  for (const Eigen::Vector2d &p : points) {
    nearest2 = std::min(nearest2, squaredDistance(footprint, p.x(), p.y()));
  }
  return std::sqrt(nearest2);
}

double freeTravel(const std::vector<Eigen::Vector2d> &points, const Footprint &footprint,
                  const Twist2 &arc, double horizon, double tolerance)
{
  constexpr double kStraight = 1e-6; // rad per metre
  check(footprint);
  if (!(horizon >= 0.0)) {
    throw LogicError("a horizon of " + std::to_string(horizon) + " must not be negative");
  }
  if (arc.v == 0.0 && arc.w == 0.0) {
    return horizon;
  }
  if (std::abs(arc.w) <= kStraight * std::abs(arc.v)) {
    const double direction = arc.v > 0.0 ? 1.0 : -1.0;
    double travel = horizon;
    for (const Eigen::Vector2d &p : points) {
      travel = std::min(travel, straightTravel(footprint, p.x(), p.y(), direction, tolerance));
    }
    return travel;
  }
  const double y = arc.v / arc.w;
  const double metres = y == 0.0 ? 1.0 : std::abs(y); // per radian
  const Turn turn = turnAbout(footprint, y, arc.w > 0.0 ? 1.0 : -1.0);
  const double most = horizon / metres;
  double angle = most;
  for (const Eigen::Vector2d &p : points) {
    angle = std::min(angle, turnTravel(turn, p, tolerance, angle));
  }
  return angle < most ? std::min(horizon, angle * metres) : horizon;
}

} // namespace homeward
