// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/arrival_trials.h>

#include "has_room.h"
#include "median.h"

#include <homeward/camera/rim.h>
#include <homeward/core/error.h>

#include <algorithm>

namespace homeward
{
namespace
{

constexpr double kArrivedWithin = 0.3; // metres

/** Starts are drawn from another seed than homes. */
constexpr std::uint64_t kStartSeed = 0x9e3779b97f4a7c15ULL;

/** A homing method whose distance proxies are wrong. */
class WrongProxy final : public HomingMethod
{
public:
  WrongProxy(std::unique_ptr<HomingMethod> method, double factor)
      : m_method(std::move(method)), m_factor(factor)
  {}

  std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) override
  {
    std::optional<HomeVector> home = m_method->compute(current, snapshot);
    if (home) {
      home->distanceProxy *= m_factor;
    }
    return home;
  }

private:
  std::unique_ptr<HomingMethod> m_method;
  double m_factor;
};

/** Notes where the robot truly is whenever its time goes on. */
class WatchedClock final : public Clock
{
public:
  explicit WatchedClock(Simulator &simulator) : m_simulator(simulator) {}

  Time now() const override { return m_simulator.clock().now(); }

  void sleepUntil(Time instant) override
  {
    m_simulator.clock().sleepUntil(instant);
    way.push_back(m_simulator.truth().pose.translation());
  }

  std::vector<Eigen::Vector2d> way;

private:
  Simulator &m_simulator;
};

/** A start for each home that has one, in the order of the homes. */
std::vector<std::pair<Pose2, Pose2>> homesAndStarts(Simulator &simulator,
                                                    const ArrivalOptions &options)
{
  constexpr std::size_t kHomes = 3;   // drawn for a run; not all will do
  constexpr std::size_t kStarts = 40; // likewise
  const FreeSpace &space = simulator.freeSpace();
  std::vector<Pose2> places = randomPoses(space, kStarts * options.runs, options.seed ^ kStartSeed);
  std::vector<std::pair<Pose2, Pose2>> result;
  for (const Pose2 &home : randomPoses(space, kHomes * options.runs, options.seed)) {
    if (result.size() == options.runs) {
      break;
    }
    if (!hasRoom(simulator, home)) {
      continue;
    }
    const auto start = std::find_if(places.begin(), places.end(), [&](const Pose2 &place) {
      const double away = (place.translation() - home.translation()).norm();
      return away >= options.nearest && away <= options.farthest &&
             space.sees(home.translation(), place.translation()) && hasRoom(simulator, place);
    });
    if (start != places.end()) {
      result.emplace_back(home, *start);
      places.erase(start);
    }
  }
  if (result.size() < options.runs) {
    throw ConfigError("the world has only " + std::to_string(result.size()) + " of " +
                      std::to_string(options.runs) +
                      " places that see a home near by; ask for less");
  }
  return result;
}

/** A robot in one light that knows, as after some time of driving, how its camera stands. */
class Robot
{
public:
  Robot(const std::shared_ptr<const Scene> &scene, const RobotDescription &robot,
        const MirrorCamera &nominal, LightPreset light, const ArrivalOptions &options)
      : m_robot(robot), m_camera(nominal)
  {
    constexpr int kPictures = 15;
    SimulatorOptions how;
    how.seed = options.seed;
    how.light = light;
    how.threads = options.threads;
    simulator = std::make_unique<Simulator>(scene, robot, nominal, how);
    std::vector<Eigen::Vector2d> shifts;
    for (const Pose2 &place : randomPoses(simulator->freeSpace(), kPictures, options.seed)) {
      if (!hasRoom(*simulator, place)) {
        continue;
      }
      if (const auto shift = rimShift(simulator->camera().grab()->image, nominal)) {
        shifts.push_back(*shift);
      }
    }
    m_camera = followRim(nominal, shifts);
  }

  /** A pilot that has just been switched on. */
  Pilot pilot(Clock &clock, const PilotOptions &options, const std::atomic<bool> &stop,
              std::unique_ptr<HomingMethod> homing = nullptr)
  {
    return {{clock, simulator->base(), simulator->laser(), simulator->camera()},
            m_robot,
            m_camera,
            options,
            stop,
            std::move(homing)};
  }

  std::unique_ptr<Simulator> simulator;

private:
  RobotDescription m_robot;
  MirrorCamera m_camera;
};

/** What is seen at a place. */
Panorama viewAt(Robot &robot, const Pose2 &place, const PilotOptions &options)
{
  const std::atomic<bool> stop = false;
  robot.simulator->kidnap(place);
  Pilot pilot = robot.pilot(robot.simulator->clock(), options, stop);
  pilot.execute(Survey{});
  return pilot.view();
}

} // namespace

double ArrivalRun::error() const
{
  return (end.translation() - home.translation()).norm();
}

double ArrivalRun::headingError() const
{
  return std::abs(wrapAngle(end.heading - home.heading));
}

bool ArrivalRun::arrived() const
{
  return outcome == HomingEnd::Arrived && error() <= kArrivedWithin;
}

std::vector<ArrivalRun> driveHome(const std::shared_ptr<const Scene> &scene,
                                  const RobotDescription &robot, const MirrorCamera &nominal,
                                  const PilotOptions &pilot, const ArrivalOptions &options,
                                  const Progress &progress)
{
  Robot then(scene, robot, nominal, options.mapLight, options);
  Robot now(scene, robot, nominal, options.nowLight, options);
  std::vector<ArrivalRun> runs;
  for (const auto &[home, start] : homesAndStarts(*now.simulator, options)) {
    ArrivalRun run;
    run.home = home;
    run.start = start;
    const Panorama snapshot = viewAt(then, home, pilot);
    now.simulator->kidnap(start);
    const Truth before = now.simulator->truth();
    const Time begin = now.simulator->clock().now();
    WatchedClock clock(*now.simulator);
    const std::atomic<bool> stop = false;
    Pilot driver = now.pilot(
        clock, pilot, stop,
        std::make_unique<WrongProxy>(makeHomingMethod(pilot.homingMethod), options.proxyFactor));
    driver.remember(NodeId{0}, snapshot);
    run.outcome = std::get<Homed>(driver.execute(HomeTo{NodeId{0}, std::nullopt, true})).end;
    run.end = now.simulator->truth().pose;
    run.seconds = toSeconds(now.simulator->clock().now() - begin);
    run.collisions = now.simulator->truth().collisions - before.collisions;
    run.way = std::move(clock.way);
    runs.push_back(std::move(run));
    if (progress) {
      progress(runs.size(), options.runs);
    }
  }
  return runs;
}

ArrivalScore scoreArrivals(const std::vector<ArrivalRun> &runs)
{
  ArrivalScore score;
  score.runs = runs.size();
  std::vector<double> errors;
  std::vector<double> headings;
  std::vector<double> seconds;
  for (const ArrivalRun &run : runs) {
    score.collisions += run.collisions;
    if (run.arrived()) {
      errors.push_back(run.error());
      headings.push_back(degrees(run.headingError()));
      seconds.push_back(run.seconds);
    }
    else if (run.outcome == HomingEnd::Arrived) {
      ++score.wronglyArrived;
    }
  }
  score.arrived = errors.size();
  score.medianError = median(errors);
  score.medianHeadingDeg = median(headings);
  score.medianSeconds = median(seconds);
  return score;
}

} // namespace homeward
