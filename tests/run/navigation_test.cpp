// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "folder.h"
#include "test_paths.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/run/navigation.h>
#include <homeward/sim/simulator.h>
#include <homeward/store/content_hash.h>
#include <homeward/store/export.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

/**
 * Places in the laboratory, each in a straight line from each; a wall can bar one way or two.
 *
 *   0 .
 *   |   .  wall
 *   |     .
 *   2 ----- 1
 */
const std::vector<Pose2> kPlaces{{-0.99, 3.18, 1.54}, {1.17, 1.25, 0.88}, {-0.93, 1.4, 2.07}};

Scene laboratory()
{
  static const Scene kScene = loadScene(dataDir() / "worlds/lab.sdf");
  return kScene;
}

/** With a wall across the way from 0 to 1. */
Scene oneWayBarred()
{
  Scene scene = laboratory();
  const auto turn = static_cast<float>(std::atan2(1.25 - 3.18, 1.17 + 0.99));
  const Eigen::Vector3f middle(0.09F, 2.21F, 0.0F);
  addBox(scene, {-0.1F, -0.8F, 0.0F}, {0.1F, 0.8F, 1.2F}, {0.3F, 0.2F, 0.1F});
  for (Mesh *mesh : {&scene.visuals.back(), &scene.collisions.back()}) {
    for (Eigen::Vector3f &vertex : mesh->vertices) {
      vertex = middle + Eigen::AngleAxisf(turn, Eigen::Vector3f::UnitZ()) * vertex;
    }
  }
  return scene;
}

/** With a wall along the y axis between 1 and the others. */
Scene bothWaysBarred()
{
  Scene scene = laboratory();
  addBox(scene, {0.0F, 0.3F, 0.0F}, {0.2F, 3.4F, 1.2F}, {0.3F, 0.2F, 0.1F});
  return scene;
}

/** A robot in that world, or in one that has changed since the map was made. */
struct Robot
{
  explicit Robot(Scene scene, const Pose2 &start = kPlaces.front(),
                 LightPreset light = LightPreset::Day)
      : simulator(share(std::move(scene)), robot, camera, at(start, light))
  {}

  static SimulatorOptions at(const Pose2 &start, LightPreset light)
  {
    SimulatorOptions options;
    options.start = start;
    options.light = light;
    return options;
  }

  double distanceTo(const Pose2 &place) const
  {
    return (simulator.truth().pose.translation() - place.translation()).norm();
  }

  RobotDescription robot = testRobot();
  MirrorCamera camera = testCamera();
  Simulator simulator;
  std::atomic<bool> stop = false;
  Pilot pilot{{simulator.clock(), simulator.base(), simulator.laser(), simulator.camera()},
              robot,
              camera,
              PilotOptions(),
              stop};
};

Panorama viewFrom(const Pose2 &place, Scene scene = laboratory())
{
  Robot robot(std::move(scene), place);
  robot.pilot.execute(Survey{});
  return robot.pilot.view();
}

class NavigationTest : public testing::Test
{
protected:
  NavigationTest()
  {
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
      const NodeId node{static_cast<std::int64_t>(i)};
      MapUpdate update;
      update.changes = {NodeAdded{{node}}};
      update.view = NewView{node, encodeView(viewFrom(kPlaces[i]))};
      file.append(update);
    }
    for (const auto &[from, to] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
      const auto bearing = [](const Pose2 &here, const Pose2 &there) {
        const Pose2 way = here.inverse() * there;
        return std::atan2(way.y, way.x);
      };
      const Pose2 &a = kPlaces[static_cast<std::size_t>(from)];
      const Pose2 &b = kPlaces[static_cast<std::size_t>(to)];
      file.append(
          {.changes = {EdgeAdded{{file.map().nextEdgeId(), NodeId{from}, NodeId{to}, bearing(a, b),
                                  bearing(b, a), (a.translation() - b.translation()).norm()}}}});
    }
  }

  Folder folder;
  MapFile file = MapFile::create(folder / "map.hwm", {"", PilotOptions().panorama, "sad", 1, {}});
};

TEST_F(NavigationTest, drivesFromGoalToGoalWithoutHavingToFindOutWhereItIs)
{
  Robot robot(laboratory());
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  int looks = 0;
  navigation.onStep = [&](const Step<NavigatorState> &step) {
    looks += std::holds_alternative<Recognise>(step.command) ? 1 : 0;
  };
  for (const NodeId goal : {NodeId{1}, NodeId{2}, NodeId{0}}) {
    const GoalReport report = navigation.driveTo(goal, 300.0);
    EXPECT_EQ(report.outcome, Outcome::Done) << report.reason;
    EXPECT_THAT(report.path, testing::Contains(goal));
    EXPECT_LT(robot.distanceTo(kPlaces[static_cast<std::size_t>(goal.value)]), 0.1);
  }
  EXPECT_EQ(looks, 1);
  EXPECT_EQ(robot.simulator.truth().collisions, 0);
}

TEST_F(NavigationTest, takesAnotherWayWhenOneIsBarred)
{
  Robot robot(oneWayBarred());
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  double tried = 0.0;
  double turnedBack = 0.0;
  navigation.onStep = [&](const Step<NavigatorState> &step) {
    const double now = toSeconds(robot.simulator.clock().now());
    if (step.state.blocked.empty()) {
      tried = now;
    }
    else if (turnedBack == 0.0) {
      turnedBack = now;
    }
  };
  const GoalReport report = navigation.driveTo(NodeId{1}, 300.0);
  EXPECT_EQ(report.outcome, Outcome::Done) << report.reason;
  EXPECT_THAT(report.path, testing::ElementsAre(NodeId{0}, NodeId{0}, NodeId{2}, NodeId{1}));
  EXPECT_LT(robot.distanceTo(kPlaces[1]), 0.1);
  EXPECT_LT(turnedBack - tried, 60.0);
  EXPECT_EQ(robot.simulator.truth().collisions, 0);
}

TEST_F(NavigationTest, saysUnreachableWhenBothWaysAreBarredAndGoesOnToTheNextGoal)
{
  Robot robot(bothWaysBarred());
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  std::optional<NodeId> left;
  Time leftAt;
  navigation.onStep = [&](const Step<NavigatorState> &step) {
    if (step.state.here != left) {
      left = step.state.here;
      leftAt = robot.simulator.clock().now();
    }
  };
  const GoalReport report = navigation.driveTo(NodeId{1}, 300.0);
  EXPECT_EQ(report.outcome, Outcome::Failed);
  EXPECT_EQ(report.reason, "unreachable: no way from node 2 to node 1; blocked: 0 - 1, 1 - 2");
  EXPECT_LT(toSeconds(robot.simulator.clock().now() - leftAt), 60.0) << "one way, tried twice";
  EXPECT_EQ(navigation.driveTo(NodeId{0}, 300.0).outcome, Outcome::Done);
  EXPECT_LT(robot.distanceTo(kPlaces[0]), 0.1);
  EXPECT_EQ(robot.simulator.truth().collisions, 0);
}

TEST_F(NavigationTest, drivesToWhereAPictureWasTakenNearANode)
{
  const Pose2 taken{-0.7, 1.6, -2.0};
  Robot robot(laboratory());
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  const std::optional<PlaceMatch> shown = navigation.addPicture("photo.jpg", viewFrom(taken));
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->node, NodeId{2});
  EXPECT_GE(shown->probability, 0.9);
  const std::optional<NodeId> goal = navigation.map().find("photo.jpg");
  ASSERT_TRUE(goal);
  const GoalReport report = navigation.driveTo(*goal, 300.0);
  EXPECT_EQ(report.reason, "arrived at photo.jpg");
  EXPECT_LT(robot.distanceTo(taken), 0.15);
  EXPECT_NEAR(wrapAngle(robot.simulator.truth().pose.heading - taken.heading), 0.0, radians(2.0));
  EXPECT_FALSE(file.map().find("photo.jpg"));
}

TEST_F(NavigationTest, makesNoGoalOfAPictureThatShowsNoKnownPlace)
{
  Robot robot(laboratory());
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  EXPECT_FALSE(navigation.addPicture("photo.jpg", viewFrom({7.5, -2.7, 1.0})));
  EXPECT_EQ(navigation.map(), file.map());
}

TEST_F(NavigationTest, givesAGoalUpWhenItsTimeIsOver)
{
  Robot robot(laboratory());
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  const GoalReport report = navigation.driveTo(NodeId{2}, 3.0);
  EXPECT_EQ(report.outcome, Outcome::Failed);
  EXPECT_EQ(report.reason, "not there after 3 s");
  EXPECT_EQ(navigation.driveTo(NodeId{2}, 300.0).outcome, Outcome::Done);
}

TEST_F(NavigationTest, aStopEndsADrive)
{
  Robot robot(laboratory());
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  robot.stop = true;
  EXPECT_EQ(navigation.driveTo(NodeId{2}, 300.0).outcome, Outcome::Stopped);
}

TEST_F(NavigationTest, aNightDriveRefreshesWhatWasSeenByDay)
{
  const ViewBytes byDay = file.view(NodeId{1});
  const std::string before = exportCanonical(file);
  {
    Robot robot(laboratory(), kPlaces.front(), LightPreset::Night);
    Navigation navigation(file, robot.pilot, robot.simulator.clock(), &file);
    const GoalReport report = navigation.driveTo(NodeId{1}, 300.0);
    EXPECT_EQ(report.outcome, Outcome::Done) << report.reason;
    EXPECT_TRUE(report.refreshed);
    EXPECT_FALSE(navigation.driveTo(NodeId{1}, 300.0).refreshed) << "it looks as it was just seen";
  }
  const ViewBytes byNight = file.view(NodeId{1});
  EXPECT_NE(byNight, byDay);
  const std::string hash = hashText(contentHash(byNight));
  EXPECT_EQ(before.find(hash), std::string::npos);
  EXPECT_NE(exportCanonical(file).find(hash), std::string::npos);
  EXPECT_EQ(file.journal().size(), 0U);
  EXPECT_EQ(refreshesOf(file, NodeId{1}), 1);

  Robot robot(laboratory(), kPlaces.front(), LightPreset::Night);
  Navigation navigation(file, robot.pilot, robot.simulator.clock());
  for (const NodeId goal : {NodeId{1}, NodeId{2}}) { // there, and on by the bearings from there
    EXPECT_EQ(navigation.driveTo(goal, 300.0).outcome, Outcome::Done);
    const Pose2 &place = kPlaces[static_cast<std::size_t>(goal.value)];
    EXPECT_LT(robot.distanceTo(place), 0.1);
    EXPECT_NEAR(wrapAngle(robot.simulator.truth().pose.heading - place.heading), 0.0, radians(2.0));
  }
}

TEST_F(NavigationTest, aPictureThatWasRefreshedOftenStaysSoThatItDoesNotCreepAway)
{
  file.append({.values = {refreshesValue(NodeId{1}, 3)}});
  Robot robot(laboratory(), kPlaces.front(), LightPreset::Night);
  Navigation navigation(file, robot.pilot, robot.simulator.clock(), &file);
  EXPECT_FALSE(navigation.driveTo(NodeId{1}, 300.0).refreshed);
  EXPECT_EQ(refreshesOf(file, NodeId{1}), 3);
  file.append({.values = {{refreshesValue(NodeId{1}, 0).first, "four"}}});
  EXPECT_THROW(refreshesOf(file, NodeId{1}), StoreError);
}

TEST_F(NavigationTest, inTheSameLightPicturesStayAndWaysAreKept)
{
  const ViewBytes before = file.view(NodeId{1});
  Robot robot(laboratory());
  Navigation navigation(file, robot.pilot, robot.simulator.clock(), &file);
  EXPECT_FALSE(navigation.driveTo(NodeId{1}, 300.0).refreshed);
  EXPECT_EQ(file.view(NodeId{1}), before);
  const std::optional<Edge> edge = file.map().edgeBetween(NodeId{0}, NodeId{1});
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->statistics.successes, 1);
  EXPECT_EQ(navigation.map(), file.map());
}

TEST_F(NavigationTest, ofAPictureThatIsAGoalNothingIsKept)
{
  const Pose2 taken{-0.7, 1.6, -2.0};
  Robot robot(laboratory(), kPlaces.front(), LightPreset::Night);
  Navigation navigation(file, robot.pilot, robot.simulator.clock(), &file);
  ASSERT_TRUE(navigation.addPicture("photo.jpg", viewFrom(taken)));
  const GoalReport report = navigation.driveTo(*navigation.map().find("photo.jpg"), 300.0);
  EXPECT_EQ(report.outcome, Outcome::Done) << report.reason;
  EXPECT_FALSE(report.refreshed);
  EXPECT_EQ(file.map().nodes().size(), kPlaces.size());
}

/** A hall whose bays, every 3 m from x = 1.5 m on, look alike. */
Scene bays()
{
  Scene scene = makeRoom(18.0F, 5.0F);
  for (int bay = 0; bay < 6; ++bay) {
    const float x = 3.0F * static_cast<float>(bay);
    addBox(scene, {x + 0.2F, 0.0F, 0.0F}, {x + 0.8F, 0.4F, 1.6F}, {0.6F, 0.1F, 0.1F});
    addBox(scene, {x + 1.6F, 0.0F, 0.5F}, {x + 1.9F, 0.2F, 2.2F}, {0.1F, 0.1F, 0.5F});
    addBox(scene, {x + 1.0F, 4.7F, 0.0F}, {x + 1.5F, 5.0F, 1.3F}, {0.1F, 0.4F, 0.1F});
    addBox(scene, {x + 2.2F, 4.8F, 0.8F}, {x + 2.6F, 5.0F, 2.0F}, {0.7F, 0.7F, 0.2F});
  }
  return scene;
}

TEST(Refresh, aPlaceThatLooksAlikeDoesNotOverwriteAPlace)
{
  const Folder folder;
  MapFile file = MapFile::create(folder / "map.hwm", {"", PilotOptions().panorama, "sad", 1, {}});
  // The map has place 1 in the next bay; what looks like it is the bay after that.
  const Pose2 left{6.0, 2.5, 0.0};
  const std::vector<Pose2> seen{left, {10.5, 2.5, 0.0}};
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const NodeId node{static_cast<std::int64_t>(i)};
    file.append({.changes = {NodeAdded{{node}}},
                 .view = NewView{node, encodeView(viewFrom(seen[i], bays()))}});
  }
  file.append({.changes = {EdgeAdded{{EdgeId{0}, NodeId{0}, NodeId{1}, 0.0, -kPi, 1.5}}}});
  const ViewBytes before = file.view(NodeId{1});
  Robot robot(bays(), left);
  Navigation navigation(file, robot.pilot, robot.simulator.clock(), &file);
  const GoalReport report = navigation.driveTo(NodeId{1}, 300.0);
  EXPECT_EQ(report.outcome, Outcome::Done) << report.reason;
  EXPECT_LT(robot.distanceTo(seen[1]), 0.1) << "it took the one for the other";
  EXPECT_FALSE(report.refreshed);
  EXPECT_EQ(file.view(NodeId{1}), before);
}

} // namespace
} // namespace homeward
