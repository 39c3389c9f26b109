// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/sim/free_space.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

FreeSpace spaceOf(Scene scene, const Eigen::Vector2d &start)
{
  const auto caster =
      std::make_shared<const RayCaster>(share(std::move(scene)), RayCaster::Layer::Collision);
  const auto map = std::make_shared<const CollisionMap>(*caster, testRobot());
  return {map, FloorGrid(*map), caster, 0.9, start};
}

// Two rooms of 4 m x 4 m, a wall at x = 4 with a door of 1 m at its upper end.
//
//   +------  ------+
//   |              |
//   |       |      |
//   |       |      |
//   +-------+------+
Scene twoRooms(float doorWidth)
{
  Scene scene = makeRoom(8.1F, 4.0F);
  addBox(scene, {4.0F, 0.0F, 0.0F}, {4.1F, 4.0F - doorWidth, 2.5F});
  return scene;
}

TEST(FreeSpace, areaOfARoomIsWhatTheBodyLeavesOfIt)
{
  const FreeSpace space = spaceOf(makeRoom(4.0F, 3.0F), {2.0, 1.5});
  EXPECT_NEAR(space.area(), 3.5 * 2.5, 0.6);
  EXPECT_TRUE(space.free({0.3, 0.3}));
  EXPECT_FALSE(space.free({0.15, 1.5}));
  EXPECT_FALSE(space.free({7.0, 1.5})) << "outside the walls there is no room";
}

TEST(FreeSpace, doorOfTheBodysWidthLetsItThroughANarrowerOneDoesNot)
{
  const FreeSpace open = spaceOf(twoRooms(0.6F), {2.0, 2.0});
  EXPECT_TRUE(open.reachable({6.0, 2.0}));
  const FreeSpace closed = spaceOf(twoRooms(0.44F), {2.0, 2.0});
  EXPECT_FALSE(closed.reachable({6.0, 2.0}));
  EXPECT_TRUE(closed.free({6.0, 2.0}));
  EXPECT_NEAR(closed.areaAround({6.0, 2.0}), closed.area(), 0.5);
}

TEST(FreeSpace, slantingPassageIsFreeForABodyThatTurnsIntoIt)
{
  // Two walls at 45 degrees leave 60 cm; the body is 49 cm wide and 70 cm from corner to corner.
  Scene scene = makeRoom(8.0F, 8.0F);
  const Eigen::Rotation2Df turn(static_cast<float>(radians(45.0)));
  for (const float side : {-1.0F, 1.0F}) {
    Mesh wall = boxMesh({-2.0F, side * 0.35F - 0.05F, 0.0F}, {2.0F, side * 0.35F + 0.05F, 2.0F});
    for (Eigen::Vector3f &vertex : wall.vertices) {
      vertex.head<2>() = turn * vertex.head<2>() + Eigen::Vector2f(4.0F, 4.0F);
    }
    scene.collisions.push_back(wall);
  }
  EXPECT_TRUE(spaceOf(std::move(scene), {1.0, 1.0}).reachable({4.0, 4.0}));
}

TEST(FreeSpace, sightEndsAtWallsAndPassesOverTables)
{
  Scene scene = twoRooms(1.0F);
  addBox(scene, {1.5F, 1.0F, 0.0F}, {2.5F, 2.0F, 0.75F});
  const FreeSpace space = spaceOf(std::move(scene), {1.0, 3.0});
  EXPECT_TRUE(space.sees({0.5, 1.5}, {3.5, 1.5})) << "over the table";
  EXPECT_FALSE(space.sees({2.0, 2.5}, {6.0, 2.5})) << "through the wall";
  EXPECT_TRUE(space.sees({2.0, 3.5}, {6.0, 3.5})) << "through the door";
  EXPECT_TRUE(space.sees({2.0, 3.5}, {2.0, 3.5})) << "itself";
}

TEST(FreeSpace, pathInTheOpenIsAsLongAsTheStraightLineWithinThreePercent)
{
  const FreeSpace space = spaceOf(makeRoom(10.0F, 10.0F), {5.0, 5.0});
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * kPi * i / 24.0;
    const Eigen::Vector2d end(5.0 + 4.0 * std::cos(angle), 5.0 + 4.0 * std::sin(angle));
    const auto length = space.pathLength({5.0, 5.0}, end, 10.0);
    ASSERT_TRUE(length);
    EXPECT_NEAR(*length, 4.0, 0.03 * 4.0 + 0.08) << "at " << degrees(angle);
  }
}

TEST(FreeSpace, pathGoesRoundTheWallAndEndsAtItsLimit)
{
  const FreeSpace space = spaceOf(twoRooms(1.0F), {2.0, 2.0});
  const auto around = space.pathLength({3.5, 0.5}, {4.6, 0.5}, 20.0);
  ASSERT_TRUE(around);
  EXPECT_GT(*around, 5.0);
  EXPECT_LT(*around, 6.6);
  EXPECT_FALSE(space.pathLength({3.5, 0.5}, {4.6, 0.5}, *around - 0.1));
  EXPECT_TRUE(space.pathLength({3.5, 0.5}, {4.6, 0.5}, *around + 0.01));
  EXPECT_FALSE(space.pathLength({3.5, 0.5}, {20.0, 0.5}, 100.0)) << "outside";
}

TEST(FreeSpace, floorPlanShowsWallsBlackAndTheRoomWhite)
{
  const FloorPlan plan = spaceOf(makeRoom(4.0F, 3.0F), {2.0, 1.5}).floorPlan();
  const auto gray = [&](double x, double y) {
    const Eigen::Vector2d pixel = plan.pixel({x, y});
    return plan.image.at<unsigned char>(static_cast<int>(std::lround(pixel.y())),
                                        static_cast<int>(std::lround(pixel.x())));
  };
  EXPECT_EQ(gray(2.0, 1.5), 255);
  EXPECT_EQ(gray(4.05, 1.5), 0);
  EXPECT_EQ(gray(0.1, 1.5), 190);
  EXPECT_GT(plan.pixel({2.0, 0.5}).y(), plan.pixel({2.0, 2.5}).y()) << "y grows upwards";
}

TEST(DefaultStart, isTheFreePlaceNearestTheOriginAndTheSameEveryTime)
{
  const Scene scene = makeRoom(6.0F, 5.0F);
  const Pose2 start = defaultStart(scene, testRobot());
  EXPECT_NEAR(start.x, 0.75, 0.12);
  EXPECT_NEAR(start.y, 0.75, 0.12);
  EXPECT_EQ(start.heading, 0.0);
  EXPECT_EQ(start.x, defaultStart(scene, testRobot()).x);
}

TEST(DefaultStart, prefersAnEnclosedRoomToALargerYardAndASolid)
{
  // A yard of crates round a house of 4 m x 4 m, and a solid block of 4 m x 4 m.
  Scene scene = makeRoom(4.0F, 4.0F);
  addBox(scene, {-9.0F, -9.0F, 0.0F}, {-8.0F, -8.0F, 1.0F});
  addBox(scene, {12.0F, 12.0F, 0.0F}, {13.0F, 13.0F, 1.0F});
  addBox(scene, {-6.0F, -6.0F, 0.0F}, {-1.6F, -1.6F, 2.0F});
  const Pose2 start = defaultStart(scene, testRobot());
  EXPECT_GT(start.x, 0.0);
  EXPECT_LT(start.x, 4.0);
  EXPECT_GT(start.y, 0.0);
  EXPECT_LT(start.y, 4.0);
}

TEST(DefaultStart, refusesAWorldWithoutRoom)
{
  EXPECT_THROW(defaultStart(Scene{}, testRobot()), ConfigError);
  EXPECT_THROW(defaultStart(makeRoom(0.3F, 0.3F), testRobot()), ConfigError);
}

} // namespace
} // namespace homeward
