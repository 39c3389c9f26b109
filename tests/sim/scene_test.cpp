// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/scene.h>

#include <homeward/core/error.h>

#include "test_paths.h"

#include <gmock/gmock.h>

#include <fstream>

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace homeward
{
namespace
{

/** A folder with a world and its models, gone after the test. */
class SceneTest : public testing::Test
{
protected:
  SceneTest()
  {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    m_folder = fs::path(testing::TempDir()) / ("homeward_scene_" + test);
    fs::remove_all(m_folder);
    fs::create_directories(m_folder / "worlds");
  }
  ~SceneTest() override { fs::remove_all(m_folder); }
  SceneTest(const SceneTest &) = delete;
  SceneTest &operator=(const SceneTest &) = delete;

  void write(const fs::path &name, const std::string &text)
  {
    fs::create_directories((m_folder / name).parent_path());
    std::ofstream(m_folder / name) << text;
  }

  /** A model folder whose only visual and collision is `geometry`. */
  void writeModel(const std::string &name, const std::string &geometry)
  {
    write("models/" + name + "/model.config",
          "<model><name>" + name + "</name><sdf version='1.6'>model.sdf</sdf></model>");
    write("models/" + name + "/model.sdf", "<sdf version='1.6'><model name='" + name +
                                               "'><link name='link'><visual name='v'>" + geometry +
                                               "</visual><collision name='c'>" + geometry +
                                               "</collision></link></model></sdf>");
  }

  Scene load(const std::string &inWorld)
  {
    write("worlds/test.world", "<?xml version='1.0'?><sdf version='1.6'><world name='test'>" +
                                   inWorld + "</world></sdf>");
    return loadScene(m_folder / "worlds" / "test.world");
  }

  fs::path m_folder;
};

std::string box(const std::string &size)
{
  return "<geometry><box><size>" + size + "</size></box></geometry>";
}

std::string modelOf(const std::string &name, const std::string &pose, const std::string &geometry)
{
  return "<model name='" + name + "'><static>1</static><pose frame=''>" + pose +
         "</pose><link name='link'><visual name='v'>" + geometry + "</visual></link></model>";
}

void expectBounds(const std::vector<Mesh> &meshes, const Eigen::Vector3f &low,
                  const Eigen::Vector3f &high, float tolerance = 1e-3F)
{
  const Eigen::AlignedBox3f box = boundsOf(meshes);
  EXPECT_LT((box.min() - low).norm(), tolerance) << box.min().transpose();
  EXPECT_LT((box.max() - high).norm(), tolerance) << box.max().transpose();
}

TEST_F(SceneTest, PosesOfModelLinkAndVisualCompose)
{
  const Scene scene = load("<model name='m'><pose>1 2 3 0 0 1.5707963</pose>"
                           "<link name='l'><pose>1 0 0 0 0 0</pose>"
                           "<visual name='v'><pose>0 1 0 0 0 0</pose>" +
                           box("2 0.2 0.4") + "</visual></link></model>");
  // The quarter turn makes the model's x the world's y.
  expectBounds(scene.visuals, {-0.1F, 2.0F, 2.8F}, {0.1F, 4.0F, 3.2F});
  EXPECT_THAT(scene.problems, IsEmpty());
  EXPECT_EQ(scene.visuals.front().model, "m");
}

TEST_F(SceneTest, IncludesAreFoundInModelsBesideTheWorldsFolderAndMayBeNested)
{
  writeModel("crate", box("1 1 1"));
  const Scene scene = load("<include><uri>model://crate</uri><name>a</name>"
                           "<pose>5 0 0.5 0 0 0</pose></include>"
                           "<model name='outer'><include><uri>model://crate</uri></include>"
                           "<pose frame=''>-5 0 0.5 0 0 0</pose></model>");
  EXPECT_THAT(scene.problems, IsEmpty());
  ASSERT_EQ(scene.visuals.size(), 2U);
  expectBounds(scene.visuals, {-5.5F, -0.5F, 0.0F}, {5.5F, 0.5F, 1.0F});
  expectBounds(scene.collisions, {-5.5F, -0.5F, 0.0F}, {5.5F, 0.5F, 1.0F});
}

TEST_F(SceneTest, IncludesOfAnotherSdfVersionLoadToo)
{
  writeModel("crate", box("1 1 1"));
  write("worlds/test.world", "<sdf version='1.7'><world name='w'><include>"
                             "<uri>model://crate</uri><pose>0 3 0 0 0 0</pose></include>"
                             "</world></sdf>");
  const Scene scene = loadScene(m_folder / "worlds" / "test.world");
  expectBounds(scene.visuals, {-0.5F, 2.5F, -0.5F}, {0.5F, 3.5F, 0.5F});
}

TEST_F(SceneTest, AMissingIncludeIsNamedAndTheRestLoads)
{
  const Scene scene = load("<include><uri>model://nowhere</uri></include>" +
                           modelOf("good", "0 0 0 0 0 0", box("1 1 1")));
  EXPECT_EQ(scene.visuals.size(), 1U);
  EXPECT_THAT(scene.problems, ElementsAre(AllOf(HasSubstr("nowhere"), HasSubstr("left out"))));
}

TEST_F(SceneTest, AMissingOrBrokenMeshIsNamedAndTheRestLoads)
{
  write("models/bad/broken.dae", "<COLLADA><asset></asset><library_effects><color>a b");
  writeModel("bad", "<geometry><mesh><uri>model://bad/broken.dae</uri></mesh></geometry>");
  writeModel("gone", "<geometry><mesh><uri>model://gone/no.dae</uri></mesh></geometry>");
  const Scene scene = load("<include><uri>model://bad</uri></include>"
                           "<include><uri>model://gone</uri></include>" +
                           modelOf("good", "0 0 0 0 0 0", box("1 1 1")));
  EXPECT_EQ(scene.visuals.size(), 1U);
  EXPECT_THAT(scene.problems, testing::Contains(AllOf(HasSubstr("'bad'"), HasSubstr("broken"))));
  EXPECT_THAT(scene.problems, testing::Contains(AllOf(HasSubstr("'gone'"), HasSubstr("no.dae"))));
}

TEST_F(SceneTest, AModelOutsideReasonIsNamedAndLeftOut)
{
  const Scene scene = load(modelOf("balloon", "0 0 5000 0 0 0", box("1 1 1")) +
                           modelOf("good", "0 0 0 0 0 0", box("1 1 1")));
  EXPECT_EQ(scene.visuals.size(), 1U);
  EXPECT_THAT(scene.problems, ElementsAre(HasSubstr("'balloon'")));
}

TEST_F(SceneTest, AMissingTextureIsNamedAndTheMeshDrawnPlain)
{
  write("models/tile/meshes/tile.mtl", "newmtl paint\nKd 1 0 0\nmap_Kd no_such_picture.png\n");
  write("models/tile/meshes/tile.obj", "mtllib tile.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                       "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  writeModel("tile", "<geometry><mesh><uri>model://tile/meshes/tile.obj</uri></mesh></geometry>");
  const Scene scene = load("<include><uri>model://tile</uri></include>");
  ASSERT_EQ(scene.visuals.size(), 1U);
  EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(scene.visuals[0].material)).texture, -1);
  EXPECT_THAT(scene.problems,
              ElementsAre(AllOf(HasSubstr("'tile'"), HasSubstr("no_such_picture.png"))));
}

TEST_F(SceneTest, GazeboColoursAndLightsAreRead)
{
  const Scene scene =
      load(modelOf("m", "0 0 0 0 0 0",
                   box("1 1 1") + "<material><script><name>Gazebo/Red</name></script></material>") +
           "<light name='l' type='point'><pose frame=''>1 2 3 0 0 0</pose>"
           "<diffuse>0.5 0.25 1 1</diffuse><attenuation><range>7</range></attenuation></light>");
  EXPECT_EQ(scene.materials.at(0).diffuse, Eigen::Vector3f(1.0F, 0.0F, 0.0F));
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].position, Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(scene.lights[0].colour, Eigen::Vector3f(0.5F, 0.25F, 1.0F));
  EXPECT_FLOAT_EQ(scene.lights[0].range, 7.0F);
}

TEST_F(SceneTest, APlaneIsNotPartOfTheBounds)
{
  const Scene scene = load(modelOf("ground", "0 0 0 0 0 0",
                                   "<geometry><plane><normal>0 0 1</normal></plane></geometry>") +
                           modelOf("good", "0 0 0 0 0 0", box("1 1 1")));
  EXPECT_EQ(scene.visuals.size(), 2U);
  expectBounds(scene.visuals, {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
}

TEST_F(SceneTest, WhatIsNoWorldIsRefusedInOneLine)
{
  write("text.world", "no XML here");
  write("other.world", "<html></html>");
  for (const char *name : {"absent.world", "text.world", "other.world", "worlds"}) {
    try {
      loadScene(m_folder / name);
      FAIL() << name;
    }
    catch (const ConfigError &error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }
}

TEST(OutsideWorlds, TheFurnishedHouseLoadsAtItsSize)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("worlds/small_house");
  const Scene scene = loadScene(outsideDataDir() / "worlds/small_house/worlds/small_house.world");
  expectBounds(scene.visuals, {-9.5F, -5.7F, 0.0F}, {9.5F, 5.7F, 3.0F}, 0.1F);
  EXPECT_GT(scene.textures.size(), 60U);
  EXPECT_EQ(scene.lights.size(), 8U);
  EXPECT_LT(scene.problems.size(), 5U);
}

TEST(OutsideWorlds, TheWarehouseLoadsAtItsSize)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("worlds/small_warehouse");
  const Scene scene =
      loadScene(outsideDataDir() / "worlds/small_warehouse/worlds/small_warehouse.world");
  expectBounds(scene.visuals, {-7.0F, -10.45F, -0.1F}, {7.0F, 10.45F, 10.1F}, 0.1F);
  EXPECT_THAT(scene.problems, IsEmpty());
}

} // namespace
} // namespace homeward
