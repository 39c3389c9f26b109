// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/core/angle.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/free_space.h>
#include <homeward/sim/scene.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <memory>
#include <sstream>

namespace homeward
{
namespace
{

RobotDescription pioneer()
{
  const std::filesystem::path file = dataDir() / "robots/pioneer3at.urdf";
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return parseRobotDescription(text.str(), file.string());
}

/** A world that ships, and places in it that a robot must be able to get to. */
struct World
{
  const char *name;
  double area; ///< square metres that can be reached, at least
  std::vector<Eigen::Vector2d> places;
};

std::ostream &operator<<(std::ostream &out, const World &world)
{
  return out << world.name;
}

class DataWorld : public testing::TestWithParam<World>
{
protected:
  std::shared_ptr<const Scene> m_scene = std::make_shared<const Scene>(
      loadScene(dataDir() / "worlds" / (std::string(GetParam().name) + ".sdf")));
  std::shared_ptr<const RayCaster> m_collisions =
      std::make_shared<const RayCaster>(m_scene, RayCaster::Layer::Collision);
};

TEST_P(DataWorld, loadsWholeWithAFreeMetreRoundItsOrigin)
{
  EXPECT_THAT(m_scene->problems, testing::IsEmpty());
  EXPECT_GE(m_scene->lights.size(), 6U);
  EXPECT_GE(m_scene->textures.size(), 20U);
  for (const float height : {0.1F, 0.33F, 0.9F}) {
    for (int degrees = 0; degrees < 360; ++degrees) {
      const auto bearing = static_cast<float>(radians(degrees));
      const Eigen::Vector3f direction(std::cos(bearing), std::sin(bearing), 0.0F);
      EXPECT_GE(m_collisions->range({0.0F, 0.0F, height}, direction, 20.0F), 0.99F)
          << degrees << " degrees, height " << height;
    }
  }
}

TEST_P(DataWorld, robotGetsEverywhereAndItsLaserSeesMostOfWhatItCouldTouch)
{
  const auto map = std::make_shared<const CollisionMap>(*m_collisions, pioneer());
  const FreeSpace free(map, FloorGrid(*map), m_collisions, 0.9, Eigen::Vector2d::Zero());
  for (const Eigen::Vector2d &place : GetParam().places) {
    EXPECT_TRUE(free.reachable(place)) << place.transpose();
  }
  EXPECT_GT(free.area(), GetParam().area);
  EXPECT_TRUE(free.reachable(defaultStart(*map, free.grid()).translation()));

  int touched = 0;
  int seen = 0;
  for (const Eigen::Vector2d &cell : free.reachableCells()) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double heading = quarter * kPi / 2.0;
      const Pose2 ahead{cell.x() + 0.1 * std::cos(heading), cell.y() + 0.1 * std::sin(heading),
                        heading};
      const std::vector<Contact> contacts = map->contacts(ahead);
      touched += static_cast<int>(!contacts.empty());
      seen += static_cast<int>(std::any_of(contacts.begin(), contacts.end(),
                                           [](const Contact &each) { return each.laserVisible; }));
    }
  }
  ASSERT_GT(touched, 100);
  EXPECT_GT(seen, 0.95 * touched);
}

INSTANTIATE_TEST_SUITE_P(
    Shipped, DataWorld,
    testing::Values(
        World{"lab",
              50.0,
              {{6.7, -0.2}, {4.0, 3.0}, {4.0, -2.6}, {-1.5, 3.2}, {8.3, 3.5}, {8.3, -3}}},
        World{"corridors", 40.0, {{-7, -0.7}, {7, -0.7}, {7, -10.7}, {-7, -10.7}, {0, -10.7}}},
        World{"rooms",
              35.0,
              {{-3.6, 3.5},
               {0.0, 3.6},
               {4.2, 3.2},
               {-3.5, -3.4},
               {3.8, -3},
               {-1.2, -4.1},
               {4.5, 0}}}),
    [](const auto &each) { return std::string(each.param.name); });

TEST(DataSample, faultsAreNamedAndTheRestLoads)
{
  const Scene scene = loadScene(dataDir() / "samples/sample.sdf");
  EXPECT_THAT(scene.problems,
              testing::UnorderedElementsAre(
                  testing::AllOf(testing::HasSubstr("sample_box"),
                                 testing::HasSubstr("no_such_picture.png")),
                  testing::AllOf(testing::HasSubstr("sample_broken"), testing::HasSubstr(".dae"))));
  for (const Mesh &mesh : scene.visuals) {
    if (mesh.model.find("sample_crate") != std::string::npos) {
      const Eigen::AlignedBox3f box = boundsOf({mesh});
      EXPECT_NEAR(box.sizes().z(), 0.6F, 1e-4F) << "the file counts centimetres";
      EXPECT_GE(scene.materials.at(static_cast<std::size_t>(mesh.material)).texture, 0);
    }
  }
  EXPECT_EQ(scene.textures.size(), 1U);
}

} // namespace
} // namespace homeward
