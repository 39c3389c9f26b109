// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_picture.h"
#include "test_paths.h"

#include <homeward/calib/mirror_circles.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace homeward
{
namespace
{

void expectNear(const Circle &found, const Circle &expected, double pixels)
{
  EXPECT_NEAR(found.centre.x(), expected.centre.x(), pixels);
  EXPECT_NEAR(found.centre.y(), expected.centre.y(), pixels);
  EXPECT_NEAR(found.radius, expected.radius, pixels);
}

TEST(MirrorCircles, areFoundWhereTheMirrorWasPainted)
{
  const UnifiedCamera camera({0.95, 280, 280, 610.0, 500.0, 0, 0, 0, 0}, 1280, 960);
  const MirrorCircles truth{{{610.0, 500.0}, 90.0}, {{610.0, 500.0}, 430.0}};
  const BoardPainter painter([&](const Eigen::Vector2d &pixel) { return camera.unproject(pixel); },
                             {{1280, 960}, {610.0, 500.0}, 90.0, 430.0}, Target{});
  Random random(5, 1);
  const auto pose = posesRound(1, {0.12, 0.075, 0.0}, 0.4, 0.5, random)[0];
  const auto found = findMirror(painter.paint(pose, random));
  ASSERT_TRUE(found);
  expectNear(found->outer, truth.outer, 0.7);
  expectNear(found->inner, truth.inner, 0.7);
}

TEST(MirrorCircles, areFoundInTheSimulatorsPicture)
{
  const cv::Mat picture = cv::imread((dataDir() / "samples/mirror.jpg").string());
  ASSERT_FALSE(picture.empty());
  const auto found = findMirror(picture);
  ASSERT_TRUE(found);
  // Nominal values; the simulated mirror is up to 3 pixels off them.
  expectNear(found->outer, {{319.5, 239.5}, 236.0}, 3.5);
  expectNear(found->inner, {{319.5, 239.5}, 30.0}, 3.5);
}

TEST(MirrorCircles, areFoundThoughThePictureCutsTheRim)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/example.jpg");
  const cv::Mat picture = cv::imread((outsideDataDir() / "mirror/example.jpg").string());
  const auto found = findMirror(picture);
  ASSERT_TRUE(found);
  expectNear(found->outer, {{980.7, 555.4}, 590.0}, 6.0); // measured by hand
  expectNear(found->inner, {{982.0, 552.0}, 236.0}, 6.0);
}

TEST(MirrorCircles, areNotInventedInNoise)
{
  cv::Mat1b noise(480, 640);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_FALSE(findMirror(noise));
  EXPECT_FALSE(findMirror(cv::Mat1b(480, 640, uchar{90})));
}

TEST(MirrorCircles, maskShowsTheRing)
{
  const MirrorCircles mirror{{{50.0, 40.0}, 10.0}, {{50.0, 40.0}, 30.0}};
  const cv::Mat mask = mirrorMask(mirror, 100, 80);
  EXPECT_EQ(mask.at<uchar>(40, 50), 0);
  EXPECT_EQ(mask.at<uchar>(40, 70), 255);
  EXPECT_EQ(mask.at<uchar>(40, 81), 0);
}

} // namespace
} // namespace homeward
