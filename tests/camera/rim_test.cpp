// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/rim.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace homeward
{
namespace
{

MirrorCamera camera()
{
  return {UnifiedCamera({0.95, 108, 108, 319.5, 239.5, 0, 0, 0, 0}, 640, 480),
          {30.0, 220.0},
          {},
          MirrorRim{{318.0, 240.0}, 220.0}};
}

/** How bright things are, gray levels. */
struct Scene
{
  double scene = 150.0;
  double texture = 60.0;
  double mount = 20.0;
  double noise = 3.0;
};

/** A mirror full of texture in a plain mount, its rim moved by `shift`. */
cv::Mat3b picture(const Eigen::Vector2d &shift, const Scene &scene = {})
{
  const MirrorRim rim = *camera().rim;
  Random random(4, 0);
  cv::Mat3b result(480, 640);
  for (int v = 0; v < result.rows; ++v) {
    for (int u = 0; u < result.cols; ++u) {
      const Eigen::Vector2d away = Eigen::Vector2d(u, v) - rim.centre - shift;
      const double inside = std::clamp(0.5 + rim.radius - away.norm(), 0.0, 1.0);
      const double azimuth = std::atan2(away.y(), away.x());
      const double level = scene.scene + scene.texture * std::sin(7.0 * azimuth) *
                                             std::cos(away.norm() / 9.0 + azimuth);
      for (int c = 0; c < 3; ++c) {
        // The scene is bluer than the mount.
        const double seen = inside * level * (c == 0 ? 1.2 : 0.9) + (1.0 - inside) * scene.mount;
        result(v, u)[c] = cv::saturate_cast<uchar>(seen + random.normal(scene.noise));
      }
    }
  }
  return result;
}

class RimShift : public testing::TestWithParam<Eigen::Vector2d>
{};

TEST_P(RimShift, IsFoundToATenthOfAPixel)
{
  const auto colour = rimShift(picture(GetParam()), camera());
  ASSERT_TRUE(colour);
  EXPECT_LT((*colour - GetParam()).norm(), 0.1);
  cv::Mat gray;
  cv::cvtColor(picture(GetParam()), gray, cv::COLOR_BGR2GRAY);
  const auto found = rimShift(gray, camera());
  ASSERT_TRUE(found);
  EXPECT_LT((*found - GetParam()).norm(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Shifts, RimShift,
                         testing::Values(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(-2.4, 0.3),
                                         Eigen::Vector2d(3.3, -4.2), Eigen::Vector2d(-0.5, 7.0)));

TEST(RimShift, IsFoundInASceneAsDarkAsTheMount)
{
  const Eigen::Vector2d truth(1.7, -1.1);
  const auto found = rimShift(picture(truth, {25.0, 12.0, 24.0, 3.0}), camera());
  ASSERT_TRUE(found);
  EXPECT_LT((*found - truth).norm(), 0.6);
}

TEST(RimShift, IsNotGuessedInTheDarkOrWhenCovered)
{
  const Eigen::Vector2d truth(1.7, -1.1);
  EXPECT_FALSE(rimShift(picture(truth, {0.0, 0.0, 0.0, 3.0}), camera()));
  EXPECT_FALSE(rimShift(cv::Mat3b(480, 640, cv::Vec3b(90, 90, 90)), camera()));
  EXPECT_FALSE(rimShift(cv::Mat1b(480, 640, uchar{0}), camera()));
}

TEST(RimShift, IsNotFollowedBeyondReach)
{
  const auto found = rimShift(picture({25.0, 0.0}), camera());
  EXPECT_FALSE(found) << found->transpose();
}

TEST(RimShift, NeedsARimInTheFileAndAPictureOfTheCamera)
{
  MirrorCamera without = camera();
  without.rim.reset();
  EXPECT_FALSE(rimShift(picture({1.0, 1.0}), without));
  EXPECT_THROW(rimShift(cv::Mat1b(10, 10, uchar{0}), camera()), LogicError);
  EXPECT_THROW(rimShift(cv::Mat1f(480, 640, 0.0F), camera()), LogicError);
}

TEST(FollowRim, MovesPrincipalPointAndRimToTheMiddleOfWhatWasSaid)
{
  const MirrorCamera moved = followRim(camera(), {{2.0, -1.0}, {2.2, -1.2}, {7.0, 7.0}});
  EXPECT_DOUBLE_EQ(moved.model.parameters().cx, 319.5 + 2.2);
  EXPECT_DOUBLE_EQ(moved.model.parameters().cy, 239.5 - 1.0);
  EXPECT_DOUBLE_EQ(moved.rim->centre.x(), 318.0 + 2.2);
  EXPECT_EQ(followRim(camera(), {}).model.parameters().cx, 319.5);
}

TEST(CameraFileRim, ComesBackAndIsChecked)
{
  const MirrorCamera again = parseMirrorCamera(formatMirrorCamera(camera()), "again.yaml");
  ASSERT_TRUE(again.rim);
  EXPECT_EQ(again.rim->centre, camera().rim->centre);
  EXPECT_EQ(again.rim->radius, 220.0);
  MirrorCamera flat = camera();
  flat.rim->radius = -1.0;
  EXPECT_THROW(parseMirrorCamera(formatMirrorCamera(flat), "flat.yaml"), ConfigError);
}

} // namespace
} // namespace homeward
