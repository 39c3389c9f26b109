// SPDX-License-Identifier: GPL-3.0-or-later
#include "walkers.h"

#include <algorithm>
#include <string>

namespace homeward
{

namespace
{

constexpr std::uint32_t kWalkStream = 406;
constexpr double kStartClear = 2.0; // metres between the robot and who begins to walk
constexpr double kPeopleClear = 0.7;
/** 0.6 m between a robot of 0.36 m round its middle and a person of 0.26 m. */
constexpr double kRobotClear = 0.6 + 0.36 + 0.26;
constexpr double kBoxClear = 0.35;  // metres from a person's middle
constexpr double kLongestLeg = 8.0; // metres
constexpr double kCheck = 0.05;     // metres between points of a way that is looked at
constexpr double kPace = 0.2;       // metres of a step that is looked at before turning
constexpr int kTries = 40;

bool nearerThan(double clear, const Eigen::Vector2d &other, const Eigen::Vector2d &at,
                const Eigen::Vector2d &next)
{
  const double then = (next - other).norm();
  return then < clear && then < (at - other).norm();
}

double distanceTo(const Eigen::AlignedBox3f &box, const Eigen::Vector2d &point)
{
  const Eigen::Vector3f at(static_cast<float>(point.x()), static_cast<float>(point.y()),
                           box.center().z());
  return static_cast<double>(box.exteriorDistance(at));
}

} // namespace

Walkers::Walkers(const FreeSpace &space, std::size_t count, const Pose2 &robot, std::uint64_t seed)
    : m_space(space), m_cells(space.reachableCells()), m_random(seed, kWalkStream)
{
  for (int i = 0; m_walkers.size() < count && i < kTries * static_cast<int>(count); ++i) {
    const Eigen::Vector2d at = randomPlace();
    const bool clear = (at - robot.translation()).norm() > kStartClear &&
                       std::none_of(m_walkers.begin(), m_walkers.end(), [&](const Walker &other) {
                         return (at - other.at).norm() < kPeopleClear;
                       });
    if (clear) {
      const double speed = m_random.uniform(0.5, 1.0);
      m_walkers.push_back({at, at, speed, Time{}, drawPersonColours(m_random)});
    }
  }
}

void Walkers::walk(Time now, Duration step, const Pose2 &robot,
                   const std::vector<Eigen::AlignedBox3f> &inTheWay)
{
  const Around around{robot.translation(), inTheWay};
  for (Walker &walker : m_walkers) {
    if (now < walker.waitsUntil) {
      continue;
    }
    const double pace = walker.speed * toSeconds(step);
    if ((walker.goal - walker.at).norm() < pace) {
      turn(walker, now, around);
      continue;
    }
    const Eigen::Vector2d next = walker.at + pace * (walker.goal - walker.at).normalized();
    if (mayStep(walker, next, around)) {
      walker.at = next;
    }
    else {
      walker.waitsUntil = now + fromSeconds(m_random.uniform(2.0, 5.0));
      walker.goal = walker.at;
    }
  }
}

std::vector<Eigen::Vector2d> Walkers::places() const
{
  std::vector<Eigen::Vector2d> places;
  std::transform(m_walkers.begin(), m_walkers.end(), std::back_inserter(places),
                 [](const Walker &walker) { return walker.at; });
  return places;
}

void Walkers::addTo(Scene &scene) const
{
  for (std::size_t i = 0; i < m_walkers.size(); ++i) {
    addPerson(scene, "person_" + std::to_string(i), m_walkers[i].at.cast<float>(),
              m_walkers[i].colours);
  }
}

Eigen::Vector2d Walkers::randomPlace()
{
  const double share = m_random.uniform(0.0, static_cast<double>(m_cells.size()));
  return m_cells[std::min(m_cells.size() - 1, static_cast<std::size_t>(share))];
}

bool Walkers::straightWay(const Eigen::Vector2d &from, const Eigen::Vector2d &to) const
{
  const double length = (to - from).norm();
  for (double way = 0.0; way < length; way += kCheck) {
    if (!m_space.free(from + way / length * (to - from))) {
      return false;
    }
  }
  return length > 0.0 && length < kLongestLeg;
}

bool Walkers::mayStep(const Walker &walker, const Eigen::Vector2d &next, const Around &around) const
{
  return !nearerThan(kRobotClear, around.robot, walker.at, next) &&
         std::none_of(m_walkers.begin(), m_walkers.end(),
                      [&](const Walker &other) {
                        return &other != &walker &&
                               nearerThan(kPeopleClear, other.at, walker.at, next);
                      }) &&
         std::none_of(around.boxes.begin(), around.boxes.end(),
                      [&](const Eigen::AlignedBox3f &box) {
                        const double then = distanceTo(box, next);
                        return then < kBoxClear && then <= distanceTo(box, walker.at);
                      });
}

void Walkers::turn(Walker &walker, Time now, const Around &around)
{
  for (int i = 0; i < kTries; ++i) {
    const Eigen::Vector2d goal = randomPlace();
    if (straightWay(walker.at, goal) &&
        mayStep(walker, walker.at + kPace * (goal - walker.at).normalized(), around)) {
      walker.goal = goal;
      return;
    }
  }
  walker.waitsUntil = now + fromSeconds(m_random.uniform(2.0, 5.0));
}

} // namespace homeward
