// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/laser/clearance.h>
#include <homeward/laser/local_drive.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace homeward
{

/**
 * A floor plan drawn in characters, 0.15 m wide and 0.30 m high each: '#' is solid, 'S' the start,
 * heading right, 'G' the goal. Walls are points 3 cm apart on the borders of the solid cells.
 */
class PointWorld
{
public:
  static constexpr double kWide = 0.15;
  static constexpr double kHigh = 0.30;

  explicit PointWorld(std::vector<std::string> drawing) : m_drawing(std::move(drawing))
  {
    for (int row = 0; row < rows(); ++row) {
      for (int column = 0; column < columns(row); ++column) {
        const char kind =
            m_drawing[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        const Eigen::Vector2d centre((column + 0.5) * kWide, -(row + 0.5) * kHigh);
        if (kind == 'S') {
          start = {centre.x(), centre.y(), 0.0};
        }
        else if (kind == 'G') {
          goal = centre;
        }
        else if (kind == '#') {
          addBorders(row, column, centre);
        }
      }
    }
  }

  Pose2 start;
  Eigen::Vector2d goal{0.0, 0.0};
  std::vector<Eigen::Vector2d> points;

  /** Something solid covers part of the footprint. */
  bool touches(const Pose2 &wMr, const Footprint &footprint) const
  {
    const Pose2 rMw = wMr.inverse();
    return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector2d &p) {
      constexpr double kReach = 0.5;
      return (p - wMr.translation()).squaredNorm() < kReach * kReach &&
             clearance({rMw * p}, footprint) <= 0.0;
    });
  }

private:
  int rows() const { return static_cast<int>(m_drawing.size()); }

  int columns(int row) const
  {
    return static_cast<int>(m_drawing[static_cast<std::size_t>(row)].size());
  }

  bool solid(int row, int column) const
  {
    return row >= 0 && row < rows() && column >= 0 && column < columns(row) &&
           m_drawing[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#';
  }

  void addBorders(int row, int column, const Eigen::Vector2d &centre)
  {
    constexpr double kApart = 0.03;
    for (const auto &[dy, dx] : {std::array{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
      if (solid(row + dy, column + dx)) {
        continue;
      }
      const double length = dx != 0 ? kHigh : kWide;
      for (double along = -length / 2.0; along <= length / 2.0 + 1e-9; along += kApart) {
        points.emplace_back(centre.x() + (dx != 0 ? dx * kWide / 2.0 : along),
                            centre.y() + (dx != 0 ? along : -dy * kHigh / 2.0));
      }
    }
  }

  std::vector<std::string> m_drawing;
};

/** How a drive ended. */
enum class DriveEnd
{
  Reached,
  Blocked, ///< stood for two seconds without a way
  Touched,
  TimeOut
};

/** One drive with what is worth knowing of it. */
struct DriveLog
{
  DriveEnd end = DriveEnd::TimeOut;
  Pose2 pose;
  double seconds = 0.0;
  double path = 0.0;     ///< metres
  int turnReversals = 0; ///< changes of side between clear turns
  std::vector<Pose2> poses;
};

/** How a wheeled base follows what it is told. */
struct BaseModel
{
  double acceleration = 1e9;     ///< m/s^2
  double deceleration = 1e9;     ///< m/s^2
  double turnAcceleration = 1e9; ///< rad/s^2
  double noise = 0.0;            ///< metres, on every point seen, made of its index and the tick
};

/**
 * Closed loop at 10 Hz. The robot is given the points that a laser 0.16 m ahead of its centre sees
 * now, 180 degrees at 1 degree, and all points seen before.
 */
class DriveTrial
{
public:
  /** Twist for the points and goal given, in the robot's frame. */
  using Policy = std::function<LocalDrive::Decision(const std::vector<Eigen::Vector2d> &points,
                                                    const Eigen::Vector2d &goal)>;

  DriveTrial(const PointWorld &world, const Footprint &footprint, const BaseModel &base)
      : m_world(world), m_footprint(footprint), m_base(base), m_seen(world.points.size(), false)
  {}

  DriveLog run(const Pose2 &start, double seconds, const Policy &policy)
  {
    constexpr int kPatience = 20;
    DriveLog log;
    log.pose = start;
    int blocked = 0;
    double lastTurn = 0.0;
    for (int tick = 0; tick < static_cast<int>(seconds * 10.0); ++tick) {
      look(log.pose);
      const Eigen::Vector2d goal = log.pose.inverse() * m_world.goal;
      if (goal.norm() < 0.15) {
        log.end = DriveEnd::Reached;
        return log;
      }
      const LocalDrive::Decision decision = policy(known(log.pose, tick), goal);
      blocked = decision.state == LocalDrive::State::Blocked ? blocked + 1 : 0;
      if (blocked >= kPatience) {
        log.end = DriveEnd::Blocked;
        return log;
      }
      if (std::abs(decision.twist.w) > 0.2) {
        log.turnReversals += lastTurn * decision.twist.w < 0.0 ? 1 : 0;
        lastTurn = decision.twist.w;
      }
      if (!step(log, decision.twist)) {
        log.end = DriveEnd::Touched;
        return log;
      }
    }
    return log;
  }

private:
  void look(const Pose2 &wMr)
  {
    const Pose2 lMw = (wMr * Pose2{0.16, 0.0, 0.0}).inverse();
    std::array<double, 180> nearest{};
    nearest.fill(8.0);
    std::array<std::ptrdiff_t, 180> index{};
    index.fill(-1);
    for (std::size_t i = 0; i < m_world.points.size(); ++i) {
      const Eigen::Vector2d p = lMw * m_world.points[i];
      if (p.x() < 0.0) {
        continue;
      }
      const double beam = degrees(std::atan2(p.y(), p.x())) + 90.0;
      if (beam < 180.0 && p.norm() < nearest[static_cast<std::size_t>(beam)]) {
        nearest[static_cast<std::size_t>(beam)] = p.norm();
        index[static_cast<std::size_t>(beam)] = static_cast<std::ptrdiff_t>(i);
      }
    }
    for (const std::ptrdiff_t i : index) {
      if (i >= 0) {
        m_seen[static_cast<std::size_t>(i)] = true;
      }
    }
  }

  std::vector<Eigen::Vector2d> known(const Pose2 &wMr, int tick) const
  {
    std::vector<Eigen::Vector2d> known;
    const Pose2 rMw = wMr.inverse();
    for (std::size_t i = 0; i < m_seen.size(); ++i) {
      if (m_seen[i]) {
        const double phase = 12.9898 * static_cast<double>(i) + 78.233 * tick;
        known.push_back(rMw * m_world.points[i] +
                        m_base.noise * Eigen::Vector2d(std::sin(phase), std::cos(1.7 * phase)));
      }
    }
    return known;
  }

  /** @return false when the robot touches something on its way */
  bool step(DriveLog &log, const Twist2 &wanted)
  {
    constexpr int kParts = 5;
    constexpr double kPart = 0.02;
    const auto towards = [](double from, double to, double most) {
      return from + std::clamp(to - from, -most, most);
    };
    for (int i = 0; i < kParts; ++i) {
      const double rate = wanted.v > m_twist.v ? m_base.acceleration : m_base.deceleration;
      m_twist.v = towards(m_twist.v, wanted.v, rate * kPart);
      m_twist.w = towards(m_twist.w, wanted.w, m_base.turnAcceleration * kPart);
      log.pose = log.pose * integrate(m_twist, kPart);
      log.path += std::abs(m_twist.v) * kPart;
      log.seconds += kPart;
      if (m_world.touches(log.pose, m_footprint)) {
        return false;
      }
    }
    log.poses.push_back(log.pose);
    return true;
  }

  const PointWorld &m_world;
  Footprint m_footprint;
  BaseModel m_base;
  std::vector<bool> m_seen;
  Twist2 m_twist;
};

} // namespace homeward
