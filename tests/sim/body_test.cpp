// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/random.h>
#include <homeward/sim/collision_map.h>

#include <algorithm>
#include <gtest/gtest.h>

namespace homeward
{
namespace
{

CollisionMap mapOf(Scene scene, const RobotDescription &robot = testRobot())
{
  return {RayCaster(share(std::move(scene)), RayCaster::Layer::Collision), robot};
}

TEST(CollisionMap, boundsAreThoseOfTheWallsNotOfTheGround)
{
  const CollisionMap map = mapOf(makeRoom(4.0F, 3.0F));
  EXPECT_TRUE(map.bounds().min().isApprox(Eigen::Vector2d(-0.1, -0.1), 1e-6));
  EXPECT_TRUE(map.bounds().max().isApprox(Eigen::Vector2d(4.1, 3.1), 1e-6));
}

TEST(CollisionMap, bodyTouchesAWallWhereItsEdgeDoesWithinACell)
{
  const CollisionMap map = mapOf(makeRoom(4.0F, 3.0F));
  const double cell = map.raster().resolution;
  EXPECT_FALSE(map.touches({4.0 - 0.25 - cell, 1.5, 0.0}));
  EXPECT_TRUE(map.touches({4.0 - 0.25 + cell, 1.5, 0.0}));
  // Turned by 45 degrees the corner is what touches.
  const double corner = (0.25 + 0.245) / std::sqrt(2.0);
  EXPECT_FALSE(map.touches({4.0 - corner - 1.5 * cell, 1.5, radians(45.0)}));
  EXPECT_TRUE(map.touches({4.0 - corner + 1.5 * cell, 1.5, radians(45.0)}));
}

TEST(CollisionMap, everyPlacementAgreesWithTheRectangleItselfWithinACell)
{
  Scene scene = makeRoom(4.0F, 3.0F);
  addBox(scene, {2.0F, 1.5F, 0.0F}, {2.01F, 1.51F, 1.0F});
  const CollisionMap map = mapOf(std::move(scene));
  Random random(7, 0);
  int tested = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 wMr{random.uniform(1.2, 2.8), random.uniform(0.7, 2.3), random.uniform(-kPi, kPi)};
    const Eigen::Vector2d post = wMr.inverse() * Eigen::Vector2d(2.005, 1.505);
    const double outside = std::max(std::abs(post.x()) - 0.25, std::abs(post.y()) - 0.245);
    if (std::abs(outside) > 0.03) {
      EXPECT_EQ(map.touches(wMr), outside < 0.0)
          << wMr.x << " " << wMr.y << " " << wMr.heading << " outside by " << outside;
      ++tested;
    }
  }
  EXPECT_GT(tested, 1000);
}

TEST(CollisionMap, eachPartTouchesOnlyAtItsOwnHeight)
{
  Scene table = makeRoom(4.0F, 3.0F);
  addBox(table, {2.0F, 1.0F, 0.60F}, {3.0F, 2.0F, 0.65F});
  const CollisionMap map = mapOf(std::move(table));
  // The body passes below the table top, the mast does not.
  EXPECT_FALSE(map.touches({1.85, 1.5, 0.0}));
  EXPECT_TRUE(map.touches({1.97, 1.5, 0.0}));
}

TEST(CollisionMap, leaningBoardIsTouchedWhereItStandsAtTheBodysHeight)
{
  // It rises from the floor at x = 3 to 2 m at x = 1; the mast meets it at 95 cm, at x = 2.05.
  Scene scene = makeRoom(4.0F, 3.0F);
  Mesh board;
  board.vertices = {{3.0F, 0.0F, 0.0F}, {3.0F, 3.0F, 0.0F}, {1.0F, 3.0F, 2.0F}, {1.0F, 0.0F, 2.0F}};
  board.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.collisions.push_back(board);
  const CollisionMap map = mapOf(std::move(scene));
  EXPECT_FALSE(map.touches({1.96, 1.5, 0.0}));
  EXPECT_TRUE(map.touches({2.04, 1.5, 0.0}));
}

TEST(CollisionMap, thresholdsAreFloor)
{
  Scene low = makeRoom(4.0F, 3.0F);
  addBox(low, {1.5F, 0.0F, 0.0F}, {1.7F, 3.0F, 0.04F});
  EXPECT_FALSE(mapOf(std::move(low)).touches({1.6, 1.5, 0.0}));
  Scene high = makeRoom(4.0F, 3.0F);
  addBox(high, {1.5F, 0.0F, 0.0F}, {1.7F, 3.0F, 0.1F});
  EXPECT_TRUE(mapOf(std::move(high)).touches({1.6, 1.5, 0.0}));
}

TEST(CollisionMap, insideOfASolidIsTouchedInsideOfARoomIsNot)
{
  Scene scene = makeRoom(6.0F, 6.0F);
  addBox(scene, {2.0F, 2.0F, 0.0F}, {4.0F, 4.0F, 1.5F});
  const CollisionMap map = mapOf(std::move(scene));
  EXPECT_TRUE(map.touches({3.0, 3.0, 0.0}));
  EXPECT_FALSE(map.touches({1.0, 1.0, 0.0}));
}

TEST(CollisionMap, contactsTellWhatTheLaserPlaneMisses)
{
  Scene scene = makeRoom(4.0F, 3.0F);
  addBox(scene, {2.0F, 1.0F, 0.60F}, {2.5F, 2.0F, 0.65F});
  const CollisionMap map = mapOf(std::move(scene));
  const auto visible = [](const Contact &contact) { return contact.laserVisible; };
  const auto atTable = map.contacts({1.97, 1.5, 0.0});
  ASSERT_FALSE(atTable.empty());
  EXPECT_TRUE(std::none_of(atTable.begin(), atTable.end(), visible));
  const auto atWall = map.contacts({3.77, 1.5, 0.0});
  ASSERT_FALSE(atWall.empty());
  EXPECT_TRUE(std::all_of(atWall.begin(), atWall.end(), visible));
  EXPECT_TRUE(map.contacts({1.0, 1.5, 0.0}).empty());
}

TEST(CollisionMap, emptyWorldTouchesNothing)
{
  const CollisionMap map = mapOf(Scene{});
  EXPECT_TRUE(map.bounds().isEmpty());
  EXPECT_FALSE(map.touches({}));
  EXPECT_TRUE(map.contacts({}).empty());
}

} // namespace
} // namespace homeward
