// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "folder.h"
#include "gallery.h"
#include "test_robot.h"

#include <homeward/evaluation/mission_trial.h>
#include <homeward/evaluation/restless_world.h>
#include <homeward/store/export.h>

#include <algorithm>
#include <gtest/gtest.h>

namespace homeward
{
namespace
{

constexpr std::size_t kPeople = 4;

/** A hall of 8 m x 6 m with a chair, and a robot that stands in the middle of one side. */
class RestlessHall
{
public:
  explicit RestlessHall(const Restlessness &restlessness, std::uint64_t seed = 1, double y = 3.0)
      : m_simulator(m_scene, testRobot(), testCamera(), start(y)),
        m_restless(m_simulator, m_scene, restlessness, seed)
  {}

  void wait(Duration time) { m_simulator.clock().sleepUntil(m_simulator.clock().now() + time); }

  Simulator &simulator() { return m_simulator; }
  RestlessWorld &restless() { return m_restless; }

private:
  static std::shared_ptr<const Scene> furnished()
  {
    Scene scene = makeRoom(8.0F, 6.0F);
    addBox(scene, {5.0F, 3.0F, 0.0F}, {5.5F, 3.5F, 0.9F});
    scene.visuals.back().model = scene.collisions.back().model = "chair";
    return share(std::move(scene));
  }

  static SimulatorOptions start(double y)
  {
    SimulatorOptions options;
    options.start = Pose2{2.0, y, 0.0};
    return options;
  }

  std::shared_ptr<const Scene> m_scene = furnished();
  Simulator m_simulator;
  RestlessWorld m_restless;
};

TEST(RestlessWorld, peopleWalkNoFasterThanPeopleAndNotIntoTheRobot)
{
  RestlessHall hall({.people = kPeople});
  const Eigen::Vector2d robot = hall.simulator().truth().pose.translation();
  std::vector<Eigen::Vector2d> before = hall.restless().people();
  ASSERT_EQ(before.size(), kPeople);
  std::vector<double> walked(kPeople, 0.0);
  double nearest = 100.0;
  for (int second = 0; second < 120; ++second) {
    hall.wait(std::chrono::seconds(1));
    const std::vector<Eigen::Vector2d> now = hall.restless().people();
    for (std::size_t i = 0; i < kPeople; ++i) {
      const double way = (now[i] - before[i]).norm();
      EXPECT_LT(way, 1.05);
      EXPECT_TRUE(hall.simulator().freeSpace().free(now[i]));
      walked[i] += way;
      nearest = std::min(nearest, (now[i] - robot).norm());
    }
    before = now;
  }
  EXPECT_GT(*std::min_element(walked.begin(), walked.end()), 15.0);
  EXPECT_GT(nearest, 0.6 + 0.36);
  EXPECT_LT(nearest, 2.0) << "nobody came near";
  EXPECT_EQ(hall.simulator().truth().collisions, 0);
}

TEST(RestlessWorld, robotSeesThemPass)
{
  RestlessHall hall({.people = kPeople, .moveFurniture = 0.0});
  const auto scan = [&] { return hall.simulator().laser().scan()->ranges; };
  const std::vector<float> first = scan();
  hall.wait(std::chrono::seconds(4));
  const std::vector<float> second = scan();
  int changed = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    changed += std::abs(first[i] - second[i]) > 0.2F ? 1 : 0;
  }
  EXPECT_GT(changed, 5);
}

TEST(RestlessWorld, chairsAreMovedAndTheTruthStays)
{
  RestlessHall hall({.people = 0, .moveFurniture = 0.8, .calm = 10.0});
  const double area = hall.simulator().freeSpace().area();
  EXPECT_EQ(hall.restless().moves(), 0);
  hall.wait(std::chrono::seconds(100));
  EXPECT_GE(hall.restless().moves(), 7);
  EXPECT_LE(hall.restless().moves(), 20);
  EXPECT_EQ(hall.simulator().freeSpace().area(), area);
}

TEST(RestlessWorld, noChairComesBackToWhereTheRobotStandsByNow)
{
  constexpr double kChair = 5.2; // metres; where the chair stood at first
  int robotsThere = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RestlessHall hall({.people = 0, .moveFurniture = 0.8, .calm = 40.0}, seed, 3.25);
    while (hall.restless().moves() == 0) {
      hall.wait(std::chrono::seconds(1));
    }
    const auto x = [&] { return hall.simulator().truth().pose.x; };
    for (int tick = 0; tick < 90 && x() < kChair; ++tick) {
      hall.simulator().base().drive({0.4, 0.0});
      hall.wait(std::chrono::milliseconds(100));
    }
    hall.simulator().base().drive({});
    robotsThere += x() >= kChair ? 1 : 0;
    EXPECT_NO_THROW(hall.wait(std::chrono::seconds(200))) << "seed " << seed;
  }
  EXPECT_GE(robotsThere, 2);
}

TEST(RestlessWorld, seedDecidesEverything)
{
  const auto places = [](std::uint64_t seed) {
    RestlessHall hall({.people = kPeople, .calm = 10.0}, seed);
    hall.wait(std::chrono::seconds(30));
    return hall.restless().people();
  };
  EXPECT_EQ(places(3), places(3));
  EXPECT_NE(places(3), places(4));
}

TEST(RestlessWorld, thingsStandAmongThePeople)
{
  RestlessHall hall({.people = kPeople, .moveFurniture = 0.0});
  auto wall = std::make_shared<Scene>();
  addBox(*wall, {4.0F, 0.0F, 0.0F}, {4.2F, 6.0F, 1.2F});
  hall.restless().put(wall);
  const auto ahead = [&] {
    const std::vector<float> ranges = hall.simulator().laser().scan()->ranges;
    return static_cast<double>(ranges[ranges.size() / 2]);
  };
  const double toWall = 4.0 - 2.0 - testRobot().rMl.translation().x();
  const std::vector<Eigen::Vector2d> before = hall.restless().people();
  for (int i = 0; i < 60; ++i) {
    hall.wait(std::chrono::seconds(1));
    EXPECT_LT(ahead(), toWall + 0.1);
    const std::vector<Eigen::Vector2d> now = hall.restless().people();
    for (std::size_t k = 0; k < now.size(); ++k) {
      EXPECT_EQ(now[k].x() > 4.1, before[k].x() > 4.1) << "through the wall";
    }
  }
  EXPECT_NE(hall.restless().people(), before);
  hall.restless().put(nullptr);
  hall.wait(std::chrono::seconds(1));
  EXPECT_EQ(hall.restless().people().size(), kPeople);
}

TEST(RestlessWorld, standsStillWhenItIsOver)
{
  Simulator simulator(share(makeRoom(8.0F, 6.0F)), testRobot(), testCamera());
  {
    const RestlessWorld restless(simulator, share(makeRoom(8.0F, 6.0F)), {.people = 1}, 1);
    EXPECT_TRUE(simulator.onStep);
  }
  EXPECT_FALSE(simulator.onStep);
  simulator.clock().sleepUntil(simulator.clock().now() + std::chrono::seconds(1));
}

MissionTrial exploreAmongPeople(const std::string &map, double maxTime)
{
  MissionTrialOptions options = galleryOptions();
  options.maxTime = maxTime;
  options.restlessness = Restlessness{.people = 2};
  const std::atomic<bool> stop = false;
  return runMissionTrial(galleryTask(map), options, stop).value();
}

TEST(RestlessWorld, buildingIsExploredAmongPeople)
{
  const Folder folder;
  const MissionTrial trial = exploreAmongPeople(folder / "map.hwm", 3600.0);
  EXPECT_EQ(trial.outcome, Outcome::Done) << trial.reason;
  EXPECT_EQ(trial.truth.coverage, 1.0);
  EXPECT_EQ(trial.truth.falseEdges, 0);
  EXPECT_EQ(trial.collisions, 0);
}

TEST(RestlessWorld, mapOfTheSameSeedIsTheSame)
{
  constexpr double kSeconds = 60.0;
  const Folder folder;
  const MissionTrial first = exploreAmongPeople(folder / "first.hwm", kSeconds);
  const MissionTrial second = exploreAmongPeople(folder / "second.hwm", kSeconds);
  EXPECT_GT(first.nodes, 2U);
  EXPECT_EQ(first.distance, second.distance);
  EXPECT_EQ(exportCanonical(MapFile::open(folder / "first.hwm")),
            exportCanonical(MapFile::open(folder / "second.hwm")));
}

} // namespace
} // namespace homeward
