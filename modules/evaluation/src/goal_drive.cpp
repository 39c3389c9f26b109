// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/goal_drive.h>

#include "has_room.h"

#include <homeward/core/angle.h>
#include <homeward/core/random.h>
#include <homeward/evaluation/rendered_views.h>
#include <homeward/run/run_mission.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

constexpr double kThere = 0.3; // metres

/** Streams of random numbers, apart from those of the simulator and of other trials. */
constexpr std::uint32_t kGoalStream = 403;
constexpr std::uint32_t kKidnapGoalStream = 404;

double metresFrom(const Pose2 &robot, const Pose2 &place)
{
  return (robot.translation() - place.translation()).norm();
}

NodeId randomNode(Random &random, const TruthLog &truth)
{
  const auto count = static_cast<double>(truth.nodes.size());
  const auto index = static_cast<std::ptrdiff_t>(random.uniform(0.0, count));
  return std::next(truth.nodes.begin(), std::min(index, std::ssize(truth.nodes) - 1))->first;
}

/**
 * Puts the robot at a random node but `goal`, in a random heading in which it fits.
 * @return nothing when it fits nowhere
 */
std::optional<NodeId> putAtNode(Simulator &simulator, const TruthLog &truth, NodeId goal,
                                Random &random)
{
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    const NodeId from = randomNode(random, truth);
    Pose2 pose = truth.nodes.at(from);
    pose.heading = random.uniform(-kPi, kPi);
    if (from != goal && putAt(simulator, pose)) {
      return from;
    }
  }
  return std::nullopt;
}

} // namespace

bool FirstPlace::right() const
{
  return error <= kThere;
}

bool GoalDrive::arrived() const
{
  return outcome == Outcome::Done && error <= kThere;
}

GoalDrive driveToGoal(const GoalDriver &driver, const MapFile &file, const TruthLog &truth,
                      NodeId goal, const std::atomic<bool> &stop,
                      const std::function<void(const NavigatorState &)> &onStep)
{
  Simulator &simulator = driver.simulator;
  const Clock &clock = simulator.clock();
  const Truth before = simulator.truth();
  const Time begin = clock.now();
  const auto seconds = [&] { return toSeconds(clock.now() - begin); };
  GoalDrive drive;
  drive.goal = goal;
  drive.start = before.pose;
  Pilot pilot({simulator.clock(), simulator.base(), simulator.laser(), simulator.camera()},
              driver.robot, driver.camera, driver.pilot, stop);
  rememberAll(file, pilot);
  const Navigator navigator(driver.navigator);
  const auto enough = [&] { return seconds() > driver.maxTime; };
  const auto follow = [&](const Step<NavigatorState> &step) {
    if (onStep) {
      onStep(step.state);
    }
    if (!drive.first && !step.state.visited.empty()) {
      const NodeId node = step.state.visited.front();
      const double error = metresFrom(simulator.truth().pose, truth.nodes.at(node));
      drive.first = FirstPlace{node, error, seconds()};
    }
  };
  MissionCounts counts;
  const Finish finish = runMission(navigator, navigator.start(file.map(), goal), pilot, file.map(),
                                   nullptr, clock, counts, enough, follow);
  const Truth after = simulator.truth();
  const Pose2 &there = truth.nodes.at(goal);
  drive.outcome = finish.outcome;
  drive.reason = finish.reason;
  drive.error = metresFrom(after.pose, there);
  drive.headingError = std::abs(wrapAngle(after.pose.heading - there.heading));
  drive.distance = after.distance - before.distance;
  drive.seconds = seconds();
  drive.collisions = after.collisions - before.collisions;
  drive.unseenContacts = after.unseenContacts - before.unseenContacts;
  return drive;
}

std::vector<GoalDrive> driveToGoals(const GoalDriver &driver, const MapFile &file,
                                    const TruthLog &truth, std::size_t count, std::uint64_t seed,
                                    const std::atomic<bool> &stop)
{
  Random random(seed, kGoalStream);
  std::vector<GoalDrive> drives;
  while (truth.nodes.size() >= 2 && drives.size() < count && !stop) {
    const NodeId goal = randomNode(random, truth);
    const std::optional<NodeId> from = putAtNode(driver.simulator, truth, goal, random);
    if (!from) {
      break;
    }
    drives.push_back(driveToGoal(driver, file, truth, goal, stop));
    drives.back().from = from;
  }
  if (stop && !drives.empty()) {
    drives.pop_back();
  }
  return drives;
}

std::vector<GoalDrive> driveAfterKidnappings(const GoalDriver &driver, const MapFile &file,
                                             const TruthLog &truth, std::size_t count,
                                             std::uint64_t seed, const std::atomic<bool> &stop)
{
  constexpr std::size_t kPlaces = 20; // drawn for a kidnapping; not all will do
  Random random(seed, kKidnapGoalStream);
  std::vector<GoalDrive> drives;
  if (truth.nodes.empty()) {
    return drives;
  }
  for (const Pose2 &place : randomPoses(driver.simulator.freeSpace(), kPlaces * count, seed)) {
    if (drives.size() == count || stop) {
      break;
    }
    if (hasRoom(driver.simulator, place) && putAt(driver.simulator, place)) {
      drives.push_back(driveToGoal(driver, file, truth, randomNode(random, truth), stop));
    }
  }
  if (stop && !drives.empty()) {
    drives.pop_back();
  }
  return drives;
}

} // namespace homeward
