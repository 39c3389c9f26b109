// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/angle.h>
#include <homeward/mission/explorer.h>
#include <homeward/mission/navigator.h>

#include <algorithm>
#include <cmath>
#include <optional>
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

  Cell robot() const { return m_robot; }

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

  std::vector<Cell> nodes;                   ///< cell of each node, by id
  bool lookAlike = false;                    ///< every place looks like every other
  int homingFailures = 0;                    ///< homings still to fail
  bool shortSighted = false;                 ///< homes only to the place where it stands
  int barredHomings = 0;                     ///< homings still to be blocked
  std::vector<std::pair<Cell, Cell>> barred; ///< between these cells no homing gets through
  int blockedDrives = 0;                     ///< drives still to be blocked at once
  double besideProbability = 0.0; ///< with which a node is recognised from the cells beside it
  std::optional<NodeId> impostor; ///< wherever no node is, it looks like this one
  std::vector<NodeId> homedTo;    ///< every homing asked for
  std::vector<NodeId> madeSureOf; ///< of these, those that were to make sure
  std::vector<double> driven;     ///< bearings of the drives asked for
  int surveys = 0;

private:
  Chord chord() const
  {
    const double dx = m_robot.first - m_left.first;
    const double dy = m_left.second - m_robot.second;
    return {std::hypot(dx, dy), std::hypot(dx, dy), std::atan2(dy, dx), std::atan2(-dy, -dx)};
  }

  Report act(const Survey &)
  {
    ++surveys;
    Surveyed report{{}, chord()};
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double bearing = wrapAngle(quarter * kPi / 2.0);
      if (isFree(neighbour(bearing))) {
        report.directions.push_back({bearing, radians(60.0), range(bearing)});
      }
    }
    m_left = m_robot;
    return report;
  }

  Report act(const DriveDirection &command)
  {
    driven.push_back(command.bearing);
    const Cell next = neighbour(command.bearing);
    const bool blocked = !isFree(next) || blockedDrives > 0;
    blockedDrives = std::max(0, blockedDrives - 1);
    if (!blocked) {
      m_robot = next;
    }
    return Driven{blocked, chord()};
  }

  Report act(const Recognise &) const
  {
    Recognised report;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const NodeId node{static_cast<std::int64_t>(i)};
      if (lookAlike || nodes[i] == m_robot) {
        report.matches.push_back({node, 1.0, true, 100.0});
      }
      else if (besideProbability > 0.0 && beside(nodes[i])) {
        report.matches.push_back({node, besideProbability, false, 300.0});
      }
    }
    if (report.matches.empty() && impostor) {
      report.matches.push_back({*impostor, 0.95, true, 100.0});
    }
    return report;
  }

  Report act(const HomeTo &command)
  {
    homedTo.push_back(command.node);
    if (command.surely) {
      madeSureOf.push_back(command.node);
    }
    const Cell target = nodes.at(static_cast<std::size_t>(command.node.value));
    if (command.node == impostor && target != m_robot) {
      return Homed{command.surely ? HomingEnd::Lost : HomingEnd::Arrived, chord()};
    }
    const bool noWay = std::any_of(barred.begin(), barred.end(), [&](const auto &cells) {
      return cells == std::pair(m_robot, target) || cells == std::pair(target, m_robot);
    });
    if (noWay || barredHomings > 0) {
      barredHomings = std::max(0, barredHomings - 1);
      return Homed{HomingEnd::Blocked, chord()};
    }
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

  /** How far one can go, in forward distances. */
  double range(double bearing) const
  {
    const auto [column, row] = neighbour(bearing);
    Cell cell = m_robot;
    int cells = -1;
    do {
      cell = {cell.first + column - m_robot.first, cell.second + row - m_robot.second};
      ++cells;
    } while (isFree(cell));
    return cells;
  }

  bool beside(Cell cell) const
  {
    return std::abs(cell.first - m_robot.first) + std::abs(cell.second - m_robot.second) == 1;
  }

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
