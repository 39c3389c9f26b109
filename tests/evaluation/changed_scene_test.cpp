// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/evaluation/changed_scene.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

// A room of 6 m x 4 m with a chair and a wardrobe.
Scene furnished()
{
  Scene scene = makeRoom(6.0F, 4.0F);
  addBox(scene, {3.0F, 2.0F, 0.0F}, {3.5F, 2.5F, 0.9F});
  scene.visuals.back().model = scene.collisions.back().model = "chair";
  addBox(scene, {0.0F, 3.4F, 0.0F}, {1.2F, 4.0F, 2.0F});
  scene.visuals.back().model = scene.collisions.back().model = "wardrobe";
  return scene;
}

FreeSpace spaceOf(const Scene &scene)
{
  const auto caster = std::make_shared<const RayCaster>(share(scene), RayCaster::Layer::Collision);
  const auto map = std::make_shared<const CollisionMap>(*caster, testRobot());
  return {map, FloorGrid(*map), caster, 0.9, Eigen::Vector2d(1.5, 1.0)};
}

Eigen::AlignedBox3f boxOf(const Scene &scene, const std::string &model)
{
  std::vector<Mesh> meshes;
  for (const Mesh &mesh : scene.visuals) {
    if (mesh.model == model) {
      meshes.push_back(mesh);
    }
  }
  return boundsOf(meshes);
}

TEST(ChangedScene, chairsMoveAndWardrobesStay)
{
  const Scene scene = furnished();
  const ChangedScene changed = changeScene(scene, spaceOf(scene), {}, {.moveFurniture = 0.8}, 1);
  ASSERT_EQ(changed.moved.size(), 1U);
  EXPECT_TRUE(changed.moved.front().contains(boxOf(changed.scene, "chair")));
  const Eigen::Vector3f before = boxOf(scene, "chair").center();
  const Eigen::Vector3f after = boxOf(changed.scene, "chair").center();
  EXPECT_NEAR((after - before).norm(), 0.8F, 0.02F);
  EXPECT_EQ(boxOf(changed.scene, "wardrobe").center(), boxOf(scene, "wardrobe").center());
}

TEST(ChangedScene, peopleStandOnTheFloorAndClearOfTheViews)
{
  const Scene scene = furnished();
  const std::vector<Pose2> views{{2.0, 1.0, 0.0}, {4.5, 3.0, 0.0}};
  const ChangedScene changed = changeScene(scene, spaceOf(scene), views, {.people = 4}, 2);
  ASSERT_EQ(changed.people, 4U);
  for (int i = 0; i < 4; ++i) {
    const Eigen::AlignedBox3f person = boxOf(changed.scene, "person_" + std::to_string(i));
    EXPECT_NEAR(person.min().z(), 0.0F, 1e-6F);
    EXPECT_NEAR(person.sizes().z(), 1.72F, 1e-3F);
    for (const Pose2 &view : views) {
      const Eigen::Vector3f at(static_cast<float>(view.x), static_cast<float>(view.y), 1.0F);
      EXPECT_GE(person.exteriorDistance(at), 0.6F);
    }
  }
  EXPECT_TRUE(changed.moved.empty());
}

TEST(ChangedScene, nothingIsPutWhereThereIsNoRoom)
{
  const Scene scene = furnished();
  std::vector<Pose2> views; // everywhere
  views.reserve(24);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 6; ++column) {
      views.push_back({0.5 + column, 0.5 + row, 0.0});
    }
  }
  const ChangedScene changed =
      changeScene(scene, spaceOf(scene), views, {.people = 50, .moveFurniture = 0.8}, 3);
  EXPECT_LT(changed.people, 20U);
}

} // namespace
} // namespace homeward
