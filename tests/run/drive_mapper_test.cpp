// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "../store/store_fixture.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/run/drive_mapper.h>
#include <homeward/sim/simulator.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

/** Somebody steers a robot through a room with a box and a post in it; a map is made on the way. */
class DriveMapperTest : public StoreTest
{
protected:
  static Scene room()
  {
    Scene scene = makeRoom(6.0F, 5.0F);
    addBox(scene, {2.5F, 2.0F, 0.0F}, {3.5F, 3.0F, 0.8F}, {0.7F, 0.2F, 0.1F});
    addBox(scene, {0.0F, 3.5F, 0.0F}, {0.2F, 4.5F, 2.0F}, {0.1F, 0.2F, 0.6F});
    addBox(scene, {4.5F, 0.0F, 0.0F}, {5.2F, 0.2F, 2.2F}, {0.05F, 0.05F, 0.05F});
    return scene;
  }

  static SimulatorOptions start()
  {
    SimulatorOptions options;
    options.start = Pose2{1.2, 1.0, 0.0};
    return options;
  }

  static DriveMapperOptions options()
  {
    DriveMapperOptions options;
    options.forwardDistance = 1.5;
    return options;
  }

  MapHeader header() const
  {
    MapHeader header = smallHeader();
    header.panorama = options().panorama;
    return header;
  }

  void drive(const Twist2 &twist, double seconds)
  {
    const Time end = simulator.clock().now() + fromSeconds(seconds);
    while (simulator.clock().now() < end) {
      simulator.base().drive(twist);
      simulator.clock().sleepUntil(simulator.clock().now() + fromSeconds(0.1));
      mapper.take(simulator.base().state());
      mapper.take(*simulator.laser().scan());
      mapper.take(*simulator.camera().grab());
    }
  }

  /** Round the box, until it heads the way it began. */
  void driveRound()
  {
    for (int side = 0; side < 4; ++side) {
      drive({0.5, 0.0}, side % 2 == 0 ? 7.4 : 6.4);
      const double before = simulator.truth().pose.heading;
      while (std::abs(wrapAngle(simulator.truth().pose.heading - before)) < radians(88.0)) {
        drive({0.0, 0.4}, 0.1);
      }
      drive({}, 0.5);
    }
  }

  RobotDescription robot = testRobot();
  MirrorCamera camera = testCamera();
  Simulator simulator{share(room()), robot, camera, start()};
  MapFile file = MapFile::create(path(), header());
  DriveMapper mapper{camera, robot.rMl, file, options()};
};

TEST_F(DriveMapperTest, ClosesARoundWhereItComesToAKnownPlace)
{
  driveRound();
  drive({0.5, 0.0}, 2.0);
  mapper.finish();
  const TopologicalMap &map = file.map();
  EXPECT_GE(map.nodes().size(), 5U);
  EXPECT_LE(map.nodes().size(), 9U);
  EXPECT_GE(mapper.recognitions(), 1);
  // In a round each place has two neighbours, and there are as many ways as places.
  EXPECT_GE(map.edges().size(), map.nodes().size());
  for (const auto &[id, edge] : map.edges()) {
    EXPECT_GE(*edge.length, 0.4);
    EXPECT_LE(*edge.length, 2.5);
  }
  EXPECT_GE(map.links(NodeId{0}).size(), 2U);
}

TEST_F(DriveMapperTest, StandingStillIsOnePlace)
{
  drive({}, 3.0);
  mapper.finish();
  EXPECT_EQ(file.map().nodes().size(), 1U);
  EXPECT_TRUE(file.hasView(NodeId{0}));
  EXPECT_TRUE(file.map().hasOpenDirection(NodeId{0}));
}

TEST_F(DriveMapperTest, AStraightDriveLeavesItsDirectionDriven)
{
  drive({0.5, 0.0}, 6.5);
  mapper.finish();
  const TopologicalMap &map = file.map();
  ASSERT_GE(map.nodes().size(), 2U);
  const Edge edge = *map.edgeBetween(NodeId{0}, NodeId{1});
  EXPECT_NEAR(*edge.bearingAtA, 0.0, 0.1);
  EXPECT_NEAR(std::abs(*edge.bearingAtB), kPi, 0.1);
  EXPECT_NEAR(*edge.length, 1.6, 0.3);
  for (const Direction &direction : map.node(NodeId{0}).directions) {
    const bool ahead = std::abs(direction.bearing) < kTakenOver;
    EXPECT_EQ(direction.state, ahead ? DirectionState::Driven : DirectionState::Open);
  }
}

TEST_F(DriveMapperTest, RefusesPicturesOfAnotherSize)
{
  EXPECT_THROW(mapper.take(Frame{{}, cv::Mat(10, 10, CV_8UC1)}), ConfigError);
}

} // namespace
} // namespace homeward
