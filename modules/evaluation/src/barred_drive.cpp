// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/barred_drive.h>

#include "has_room.h"

#include <homeward/core/random.h>
#include <homeward/evaluation/barrier.h>
#include <homeward/evaluation/barrier_meetings.h>
#include <homeward/topology/planner.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward
{
namespace
{

constexpr std::uint32_t kBarrierStream = 408;

/** An edge that can be barred. */
struct BarredEdge
{
  Edge edge;
  Barrier barrier;
};

std::vector<BarredEdge> edgesToBar(const TopologicalMap &map, const TruthLog &truth)
{
  std::vector<Eigen::Vector2d> places;
  for (const auto &[id, pose] : truth.nodes) {
    places.push_back(pose.translation());
  }
  std::vector<BarredEdge> edges;
  for (const auto &[id, edge] : map.edges()) {
    const auto barrier = barrierAcross(truth.nodes.at(edge.a).translation(),
                                       truth.nodes.at(edge.b).translation(), places);
    if (barrier) {
      edges.push_back({edge, *barrier});
    }
  }
  return edges;
}

/** Takes one of them out. */
BarredEdge draw(std::vector<BarredEdge> &edges, Random &random)
{
  const auto count = static_cast<double>(edges.size());
  const auto index = static_cast<std::ptrdiff_t>(random.uniform(0.0, count));
  const auto drawn = edges.begin() + std::min(index, std::ssize(edges) - 1);
  BarredEdge edge = *drawn;
  edges.erase(drawn);
  return edge;
}

bool putInSomeHeading(Simulator &simulator, Pose2 pose, Random &random)
{
  constexpr int kTries = 50;
  for (int i = 0; i < kTries; ++i) {
    pose.heading = random.uniform(-kPi, kPi);
    if (putAt(simulator, pose)) {
      return true;
    }
  }
  return false;
}

/** Listens to a simulator's steps besides whoever did before, as long as it lives. */
class StepListener
{
public:
  StepListener(Simulator &simulator, const std::function<void(Time)> &listen)
      : m_simulator(simulator), m_before(simulator.onStep)
  {
    m_simulator.onStep = [this, listen](Time now) {
      if (m_before) {
        m_before(now);
      }
      listen(now);
    };
  }

  ~StepListener() { m_simulator.onStep = m_before; }
  StepListener(const StepListener &) = delete;
  StepListener &operator=(const StepListener &) = delete;

private:
  Simulator &m_simulator;
  std::function<void(Time)> m_before;
};

/** A barrier that stands in the simulated world as long as this lives. */
class StandingBarrier
{
public:
  StandingBarrier(const GoalDriver &driver, const Barrier &barrier) : m_driver(driver)
  {
    put(barrier.scene());
  }

  ~StandingBarrier() { put(nullptr); }
  StandingBarrier(const StandingBarrier &) = delete;
  StandingBarrier &operator=(const StandingBarrier &) = delete;

private:
  void put(const std::shared_ptr<const Scene> &things)
  {
    if (m_driver.restless != nullptr) {
      m_driver.restless->put(things);
    }
    else {
      m_driver.simulator.put(things);
    }
  }

  const GoalDriver &m_driver;
};

/** From where the robot stands to `goal`. */
BarredDrive driveAt(const GoalDriver &driver, const MapFile &file, const TruthLog &truth,
                    const BarredEdge &barred, NodeId goal, const std::atomic<bool> &stop)
{
  const BodyPart body = driver.robot.footprint();
  const double radius =
      std::hypot(std::max(-body.xMin, body.xMax), std::max(-body.yMin, body.yMax));
  BarrierMeetings meetings;
  NavigatorState end;
  const StandingBarrier standing(driver, barred.barrier);
  const StepListener listener(driver.simulator, [&](Time now) {
    const Eigen::Vector2d robot = driver.simulator.truth().pose.translation();
    meetings.note(now, barred.barrier.distanceTo(robot) - radius);
  });
  BarredDrive result{barred.edge.id, barred.barrier.width};
  result.drive = driveToGoal(driver, file, truth, goal, stop, [&](const NavigatorState &state) {
    meetings.note(driver.simulator.clock().now(), state);
    end = state;
  });
  result.noWayLeft = foundNoWay(file.map(), result.drive.outcome, end, barred.edge.id);
  result.meetings = meetings.seconds();
  return result;
}

} // namespace

bool foundNoWay(const TopologicalMap &map, Outcome outcome, const NavigatorState &end,
                EdgeId barred)
{
  if (outcome != Outcome::Failed || !end.here) {
    return false;
  }
  std::set<EdgeId> avoided{barred};
  for (const auto &[edge, failures] : end.failures) {
    avoided.insert(edge);
  }
  return !shortestPath(map, *end.here, end.goal, avoided);
}

std::vector<BarredDrive> driveAtBarriers(const GoalDriver &driver, const MapFile &file,
                                         const TruthLog &truth, std::size_t count,
                                         std::uint64_t seed, const std::atomic<bool> &stop)
{
  Random random(seed, kBarrierStream);
  std::vector<BarredEdge> left = edgesToBar(file.map(), truth);
  std::vector<BarredDrive> drives;
  while (!left.empty() && drives.size() < count && !stop) {
    const BarredEdge barred = draw(left, random);
    NodeId from = barred.edge.a;
    NodeId goal = barred.edge.b;
    if (random.uniform(0.0, 1.0) < 0.5) {
      std::swap(from, goal);
    }
    if (putInSomeHeading(driver.simulator, truth.nodes.at(from), random)) {
      drives.push_back(driveAt(driver, file, truth, barred, goal, stop));
      drives.back().drive.from = from;
    }
  }
  if (stop && !drives.empty()) {
    drives.pop_back();
  }
  return drives;
}

} // namespace homeward
