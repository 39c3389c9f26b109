// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/angle.h>
#include <homeward/mission/explorer.h>
#include <homeward/mission/navigator.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace homeward
{

/**
 * A world drawn in ASCII for missions without sensors: '.' is a place one may stand at, neighbours
 * are one forward distance apart. The robot always faces east, so bearings are compass directions.
 */
class GridWorld
{
public:
  using Cell = std::pair<int, int>; ///< column, row

  explicit GridWorld(std::vector<std::string> rows, Cell start)
      : m_rows(std::move(rows)), m_robot(start), m_left(start)
  {}

  bool isFree(Cell cell) const
  {
    return cell.second >= 0 && cell.second < static_cast<int>(m_rows.size()) && cell.first >= 0 &&
           cell.first < static_cast<int>(m_rows[static_cast<std::size_t>(cell.second)].size()) &&
           m_rows[static_cast<std::size_t>(cell.second)][static_cast<std::size_t>(cell.first)] ==
               '.';
  }

  /** Carries a command out. */
  Report execute(const Command &command)
  {
    return std::visit([this](const auto &what) { return act(what); }, command);
  }

  /** Tells the world which cell a new node names. */
  void follow(const std::vector<MapChange> &changes)
  {
    for (const MapChange &change : changes) {
      if (std::holds_alternative<NodeAdded>(change)) {
        nodes.push_back(m_robot);
      }
    }
  }

  std::vector<Cell> nodes;     ///< cell of each node, by id
  bool lookAlike = false;      ///< every place looks like every other
  int homingFailures = 0;      ///< homings still to fail
  bool shortSighted = false;   ///< homes only to the place where it stands
  std::vector<NodeId> homedTo; ///< every homing asked for

private:
  Chord chord() const
  {
    const double dx = m_robot.first - m_left.first;
    const double dy = m_left.second - m_robot.second;
    return {std::hypot(dx, dy), std::hypot(dx, dy), std::atan2(dy, dx), std::atan2(-dy, -dx)};
  }

  Report act(const Survey &)
  {
    Surveyed report{{}, chord()};
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double bearing = wrapAngle(quarter * kPi / 2.0);
      if (isFree(neighbour(bearing))) {
        report.directions.push_back({bearing, radians(60.0), 3.0});
      }
    }
    m_left = m_robot;
    return report;
  }

  Report act(const DriveDirection &command)
  {
    const Cell next = neighbour(command.bearing);
    const bool blocked = !isFree(next);
    if (!blocked) {
      m_robot = next;
    }
    return Driven{blocked, chord()};
  }

  Report act(const Recognise &) const
  {
    Recognised report;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (lookAlike || nodes[i] == m_robot) {
        report.matches.push_back({NodeId{static_cast<std::int64_t>(i)}, 1.0, true, 100.0});
      }
    }
    return report;
  }

  Report act(const HomeTo &command)
  {
    homedTo.push_back(command.node);
    const Cell target = nodes.at(static_cast<std::size_t>(command.node.value));
    if (homingFailures > 0 || (shortSighted && target != m_robot)) {
      homingFailures = std::max(0, homingFailures - 1);
      return Homed{HomingEnd::Lost, chord()};
    }
    m_robot = target;
    const Homed report{HomingEnd::Arrived, chord()};
    m_left = m_robot;
    return report;
  }

  Report act(const Finish &) const { return Interrupted{}; }

  Cell neighbour(double bearing) const
  {
    return {m_robot.first + static_cast<int>(std::lround(std::cos(bearing))),
            m_robot.second - static_cast<int>(std::lround(std::sin(bearing)))};
  }

  std::vector<std::string> m_rows;
  Cell m_robot;
  Cell m_left;
};

} // namespace homeward
