// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/true_optics.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace homeward
{
namespace
{

MirrorCamera cameraWith(double xi)
{
  UnifiedCamera::Parameters parameters;
  parameters.xi = xi;
  parameters.fx = 108.0;
  parameters.fy = 107.0;
  parameters.cx = 319.5;
  parameters.cy = 239.5;
  return {UnifiedCamera(parameters, 640, 480), {30.0, 236.0}, {-kPi / 2.0, true}};
}

TEST(TrueOptics, RayAndProjectAreInverse)
{
  for (const double xi : {0.8, 0.95, 1.0, 1.05}) {
    const TrueOptics optics = drawOptics(cameraWith(xi), 3);
    for (double u = 90.0; u < 560.0; u += 31.0) {
      for (double v = 10.0; v < 480.0; v += 29.0) {
        const auto ray = optics.ray({u, v});
        ASSERT_TRUE(ray);
        EXPECT_NEAR(ray->norm(), 1.0, 1e-12);
        EXPECT_LT((*optics.project(3.0 * *ray) - Eigen::Vector2d(u, v)).norm(), 1e-9);
      }
    }
  }
}

TEST(TrueOptics, IsWhatAHyperboloidOverACameraImages)
{
  const double e = 1.4;
  const double a = 0.03;            // half the mirror's axis, metres
  const double perspective = 300.0; // focal length of the camera, pixels
  const double apart = 2.0 * e * a; // of the two foci
  TrueOptics optics;
  optics.xi = 2.0 * e / (e * e + 1.0);
  optics.focal.setConstant(perspective * (e * e - 1.0) / (e * e + 1.0));
  for (double t = 0.2; t < 2.2; t += 0.2) {
    // The surface point on the way to the upper focus: the lower one is 2 a farther from it.
    const double r = a * (e * e - 1.0) / (1.0 + e * std::cos(t));
    const Eigen::Vector2d surface(r * std::sin(t), r * std::cos(t));
    ASSERT_NEAR((surface - Eigen::Vector2d(0.0, apart)).norm() - r, 2.0 * a, 1e-12);
    const double radius = perspective * surface.x() / (apart - surface.y());
    const auto pixel = optics.project({std::sin(t), 0.0, -std::cos(t)});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((*pixel - optics.centre).norm(), radius, 1e-9);
  }
}

TEST(TrueOptics, EqualsTheUnifiedModel)
{
  const MirrorCamera camera = cameraWith(0.9);
  const TrueOptics optics = exactOptics(camera);
  for (double azimuth = -3.0; azimuth < 3.0; azimuth += 0.5) {
    for (double elevation = -1.4; elevation < 0.6; elevation += 0.2) {
      const Eigen::Vector3d pX(std::cos(elevation) * std::cos(azimuth),
                               std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double inPicture = camera.mount.forward + azimuth;
      const Eigen::Vector3d cX(std::cos(elevation) * std::cos(inPicture),
                               std::cos(elevation) * std::sin(inPicture), -std::sin(elevation));
      EXPECT_LT((*optics.project(pX) - *camera.model.project(cX)).norm(), 1e-9);
    }
  }
}

TEST(TrueOptics, AheadIsAtTheTopAndLeftOnTheRight)
{
  const TrueOptics optics = exactOptics(cameraWith(0.95));
  EXPECT_LT(optics.project({1.0, 0.0, 0.0})->y(), 200.0);
  EXPECT_GT(optics.project({0.0, 1.0, 0.0})->x(), 360.0);
  EXPECT_LT((*optics.project({0.0, 0.0, -1.0}) - optics.centre).norm(), 1e-9);
}

TEST(TrueOptics, DrawsStayWithinTheirBoundsAndFollowTheSeed)
{
  const MirrorCamera camera = cameraWith(0.95);
  const TrueOptics exact = exactOptics(camera);
  double largestTilt = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const TrueOptics optics = drawOptics(camera, seed);
    const double tilt = std::acos(std::min(1.0, optics.pRa(2, 2)));
    largestTilt = std::max(largestTilt, tilt);
    EXPECT_LE(tilt, radians(0.5) + 1e-9);
    EXPECT_LE((optics.centre - exact.centre).norm(), 3.0);
    EXPECT_NEAR(optics.focal.x() / exact.focal.x(), 1.0, 0.005);
    EXPECT_EQ(optics.centre, drawOptics(camera, seed).centre);
  }
  EXPECT_GT(largestTilt, radians(0.4));
  EXPECT_NE(drawOptics(camera, 1).centre, drawOptics(camera, 2).centre);
}

TEST(TrueOptics, NeedsAMirror)
{
  EXPECT_THROW(exactOptics(cameraWith(0.0)), LogicError);
}

TEST(TrueOptics, EndsWhereItsPictureEnds)
{
  const TrueOptics optics = exactOptics(cameraWith(1.05)); // R stays below f / sqrt(xi^2 - 1)
  EXPECT_TRUE(optics.ray({319.5 + 330.0, 239.5}));
  EXPECT_FALSE(optics.ray({319.5 + 340.0, 239.5}));
}

} // namespace
} // namespace homeward
