// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/evaluation/rendered_views.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <set>

namespace homeward
{
namespace
{

// A room of 4 m x 3 m with a box in it, and a cupboard that the robot cannot get into.
//
//   +--------+-+
//   |  []    |c|
//   |        +-+
//   +----------+
Scene roomWithBox()
{
  Scene scene = makeRoom(4.0F, 3.0F);
  addBox(scene, {1.0F, 2.0F, 0.0F}, {1.4F, 2.4F, 1.5F}, {0.8F, 0.1F, 0.1F});
  addBox(scene, {3.0F, 1.9F, 0.0F}, {4.0F, 2.0F, 2.0F}, {0.1F, 0.1F, 0.8F});
  addBox(scene, {3.0F, 2.0F, 0.0F}, {3.1F, 3.0F, 2.0F});
  return scene;
}

FreeSpace spaceOf(const Scene &scene)
{
  const auto caster = std::make_shared<const RayCaster>(share(scene), RayCaster::Layer::Collision);
  const auto map = std::make_shared<const CollisionMap>(*caster, testRobot());
  return {map, FloorGrid(*map), caster, 0.9, Eigen::Vector2d(2.0, 1.0)};
}

TEST(Poses, standOnReachableFloorInAllHeadings)
{
  const FreeSpace space = spaceOf(roomWithBox());
  for (const std::vector<Pose2> &poses : {gridPoses(space, 0.2, 5), randomPoses(space, 120, 5)}) {
    ASSERT_GT(poses.size(), 80U);
    std::set<int> quarters;
    for (const Pose2 &pose : poses) {
      EXPECT_TRUE(space.reachable(pose.translation())) << pose.x << ", " << pose.y;
      quarters.insert(static_cast<int>(std::floor(pose.heading / (kPi / 2.0))));
    }
    EXPECT_EQ(quarters.size(), 4U);
  }
}

TEST(Poses, gridHasItsSpacingAndCoversTheFloor)
{
  const FreeSpace space = spaceOf(roomWithBox());
  const double spacing = 0.3;
  const std::vector<Pose2> poses = gridPoses(space, spacing, 7);
  for (const Pose2 &pose : poses) {
    for (const double offset : {pose.x - poses.front().x, pose.y - poses.front().y}) {
      EXPECT_NEAR(std::remainder(offset, spacing), 0.0, 1e-9);
    }
  }
  EXPECT_NEAR(static_cast<double>(poses.size()) * spacing * spacing, space.area(),
              0.2 * space.area());
}

TEST(Poses, followFromTheSeedAlone)
{
  const FreeSpace space = spaceOf(roomWithBox());
  const std::vector<Pose2> few = randomPoses(space, 5, 2);
  const std::vector<Pose2> many = randomPoses(space, 9, 2);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].x, many[i].x);
    EXPECT_EQ(few[i].heading, many[i].heading);
  }
  EXPECT_NE(randomPoses(space, 5, 3).front().x, few.front().x);
}

DataSet rendered(const std::shared_ptr<const Scene> &scene, int threads, bool exact)
{
  ViewSource source{scene, testRobot().rMp, testCamera()};
  source.exactOptics = exact;
  source.rendering.threads = threads;
  DataSet set(source.camera);
  const std::vector<Pose2> poses{{2.0, 1.0, 0.0}, {1.5, 1.2, 1.0}};
  addRenderedViews(set, source, poses, LightPreset::Day);
  addRenderedViews(set, source, {poses.front()}, LightPreset::Night);
  return set;
}

TEST(RenderedViews, areTheSameWithOneThreadAndWithTwo)
{
  const auto scene = share(roomWithBox());
  const DataSet one = rendered(scene, 1, false);
  const DataSet two = rendered(scene, 2, false);
  ASSERT_EQ(one.size(), 3U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one.view(i).file, two.view(i).file);
    EXPECT_EQ(cv::countNonZero(one.picture(i) != two.picture(i)), 0);
  }
  EXPECT_EQ(one.view(1).pose.x, 1.5);
  EXPECT_EQ(one.view(2).light, "night");
  EXPECT_GT(cv::norm(one.picture(0), one.picture(2), cv::NORM_INF), 20.0) << "night is no day";
}

TEST(RenderedViews, exactOpticsAreAsTheFileSays)
{
  // The edge of the ring lies where the camera file says, all round.
  const auto scene = share(roomWithBox());
  const auto asymmetry = [](const cv::Mat &picture) {
    const cv::Point centre(320, 240); // the nominal centre is half a pixel up and left
    int differences = 0;
    for (int radius = 230; radius < 240; ++radius) {
      differences += std::abs(picture.at<unsigned char>(centre.y, centre.x + radius) -
                              picture.at<unsigned char>(centre.y, centre.x - 1 - radius)) > 100;
    }
    return differences;
  };
  EXPECT_EQ(asymmetry(rendered(scene, 1, true).picture(0)), 0);
  EXPECT_GT(asymmetry(rendered(scene, 1, false).picture(0)), 0);
}

} // namespace
} // namespace homeward
