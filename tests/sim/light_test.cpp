// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/light_preset.h>
#include <homeward/sim/mirror_renderer.h>
#include <homeward/sim/ray_caster.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>

namespace homeward
{
namespace
{

constexpr LightPreset kAll[] = {LightPreset::Day, LightPreset::Twilight, LightPreset::Night,
                                LightPreset::TwoLamps};

/** A floor of 12 x 8 m and a roof 3 m above it, of one gray. */
std::shared_ptr<const Scene> makeHall()
{
  auto scene = std::make_shared<Scene>();
  scene->materials.emplace_back();
  for (const float z : {0.0F, 3.0F}) {
    Mesh mesh;
    mesh.vertices = {{-6.0F, -4.0F, z}, {6.0F, -4.0F, z}, {6.0F, 4.0F, z}, {-6.0F, 4.0F, z}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = 0;
    scene->visuals.push_back(mesh);
  }
  return scene;
}

/** Mean gray of the lower half of the sphere from the middle of the hall. */
double brightness(LightPreset preset)
{
  const auto scene = makeHall();
  UnifiedCamera::Parameters parameters;
  parameters.xi = 0.95;
  parameters.fx = parameters.fy = 54.0;
  parameters.cx = 159.5;
  parameters.cy = 119.5;
  const MirrorCamera camera{UnifiedCamera(parameters, 320, 240), {15.0, 118.0}, {-kPi / 2.0, true}};
  MirrorRenderer renderer(scene, lightingFor(preset, *scene), exactOptics(camera));
  Eigen::Isometry3d wMp = Eigen::Isometry3d::Identity();
  wMp.translation().z() = 0.9;
  Random noise(1, 1);
  return cv::mean(renderer.render(wMp, noise))[1];
}

TEST(LightPreset, NamesAreReadBack)
{
  for (const LightPreset preset : kAll) {
    EXPECT_EQ(parseLightPreset(name(preset)), preset);
  }
  EXPECT_THROW(parseLightPreset("dusk"), ConfigError);
}

TEST(LightPreset, DayIsBrighterThanTwilightThanNightAndNoneIsBlack)
{
  const double day = brightness(LightPreset::Day);
  const double twilight = brightness(LightPreset::Twilight);
  const double night = brightness(LightPreset::Night);
  EXPECT_GT(day, twilight + 5.0);
  EXPECT_GT(twilight, night + 5.0);
  EXPECT_GT(night, 8.0);
  EXPECT_LT(day, 200.0);
}

TEST(LightPreset, TwoLampsAreTwo)
{
  EXPECT_EQ(lightingFor(LightPreset::TwoLamps, *makeHall()).lights.size(), 2U);
}

TEST(LightPreset, AddedLampsHangBelowTheCeilingInTheFree)
{
  const auto hall = makeHall();
  const RayCaster caster(hall, RayCaster::Layer::Visual);
  const Lighting day = lightingFor(LightPreset::Day, *hall);
  ASSERT_FALSE(day.lights.empty());
  for (const Light &light : day.lights) {
    EXPECT_GT(light.position.z(), 2.0F);
    EXPECT_FALSE(caster.blocked(light.position, {light.position.x(), light.position.y(), 0.1F}));
  }
}

TEST(LightPreset, TheScenesOwnLampsAreKeptByDay)
{
  Scene hall = *makeHall();
  Light own;
  own.position = {0.0F, 0.0F, 2.5F};
  own.colour = {1.0F, 0.5F, 0.25F};
  hall.lights = {own};
  const Lighting day = lightingFor(LightPreset::Day, hall);
  EXPECT_EQ(day.lights.front().colour, own.colour);
}

TEST(RayCaster, DistancesAreThoseOfTheHall)
{
  const RayCaster caster(makeHall(), RayCaster::Layer::Visual);
  EXPECT_FLOAT_EQ(caster.range({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -2.0F}, 5.0F), 1.0F);
  EXPECT_FLOAT_EQ(caster.range({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}, 5.0F), 2.0F);
  EXPECT_TRUE(std::isinf(caster.range({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}, 1.5F)));
  EXPECT_TRUE(std::isinf(caster.range({0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, 100.0F)));
  EXPECT_TRUE(caster.blocked({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 3.5F}));
  EXPECT_FALSE(caster.blocked({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 2.5F}));
  const auto hit = caster.hit({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}, 5.0F);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->mesh, 1);
  EXPECT_FLOAT_EQ(hit->normal.z(), -1.0F);
}

} // namespace
} // namespace homeward
