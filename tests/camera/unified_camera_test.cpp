// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/unified_camera.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <gtest/gtest.h>

#include <cmath>

namespace homeward
{
namespace
{

using Parameters = UnifiedCamera::Parameters;

/** Laws of every camera, on parameter sets from a pinhole to beyond a parabola. */
class UnifiedCameraLaw : public testing::TestWithParam<Parameters>
{
protected:
  UnifiedCamera camera{GetParam(), 640, 480};
};

Eigen::Vector3d randomRay(Random &random)
{
  const double z = random.uniform(-1.0, 1.0);
  const double angle = random.uniform(-3.14, 3.14);
  const double s = std::sqrt(1.0 - z * z);
  return {s * std::cos(angle), s * std::sin(angle), z};
}

TEST_P(UnifiedCameraLaw, UnprojectInvertsProject)
{
  Random random(1, 0);
  int valid = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d ray = randomRay(random);
    const auto pixel = camera.project(ray * random.uniform(0.1, 50.0));
    // Far outside the picture the polynomial is steep and its inverse of no use.
    if (!pixel || (*pixel - Eigen::Vector2d(320, 240)).norm() > 1500.0) {
      continue;
    }
    ++valid;
    const auto back = camera.unproject(*pixel);
    ASSERT_TRUE(back) << ray.transpose();
    EXPECT_NEAR((*back - ray).norm(), 0.0, 1e-7) << ray.transpose();
  }
  EXPECT_GT(valid, 300);
}

TEST_P(UnifiedCameraLaw, ProjectInvertsUnproject)
{
  int valid = 0;
  for (int v = 0; v < 480; v += 20) {
    for (int u = 0; u < 640; u += 20) {
      const Eigen::Vector2d pixel(u, v);
      const auto ray = camera.unproject(pixel);
      if (!ray) {
        continue;
      }
      ++valid;
      EXPECT_NEAR(ray->norm(), 1.0, 1e-12);
      const auto back = camera.project(*ray);
      ASSERT_TRUE(back) << pixel.transpose();
      EXPECT_NEAR((*back - pixel).norm(), 0.0, 1e-6);
    }
  }
  EXPECT_GT(valid, 100);
}

TEST_P(UnifiedCameraLaw, PointJacobianEqualsNumericDifferences)
{
  Random random(2, 0);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d point = randomRay(random) * random.uniform(0.5, 5.0);
    UnifiedCamera::PointJacobian J_point;
    const auto pixel = camera.project(point, &J_point);
    if (!pixel || pixel->norm() > 3000.0) {
      continue;
    }
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d h = kStep * Eigen::Vector3d::Unit(k);
      const auto plus = camera.project(point + h);
      const auto minus = camera.project(point - h);
      if (!plus || !minus) {
        continue;
      }
      const Eigen::Vector2d numeric = (*plus - *minus) / (2.0 * kStep);
      EXPECT_NEAR((J_point.col(k) - numeric).norm(), 0.0, 1e-5 * (1.0 + numeric.norm())) << k;
    }
  }
}

Parameters moved(Parameters p, int k, double step)
{
  double *values[] = {&p.xi, &p.fx, &p.fy, &p.cx, &p.cy, &p.k1, &p.k2, &p.p1, &p.p2};
  *values[k] += step;
  return p;
}

TEST_P(UnifiedCameraLaw, ParameterJacobianEqualsNumericDifferences)
{
  const Eigen::Vector3d points[] = {{0.3, 0.2, 0.9}, {-1.0, 0.5, 0.8}, {0.4, -0.9, 0.7}};
  for (const Eigen::Vector3d &point : points) {
    UnifiedCamera::ParameterJacobian J_parameters;
    ASSERT_TRUE(camera.project(point, nullptr, &J_parameters));
    constexpr double kStep = 1e-6;
    for (int k = 0; k < UnifiedCamera::kParameterCount; ++k) {
      // One-sided where xi stands at its bound.
      const bool atBound = k == 0 && GetParam().xi == 0.0;
      const double down = atBound ? 0.0 : kStep;
      const UnifiedCamera plus(moved(GetParam(), k, kStep), 640, 480);
      const UnifiedCamera minus(moved(GetParam(), k, -down), 640, 480);
      const Eigen::Vector2d numeric =
          (*plus.project(point) - *minus.project(point)) / (kStep + down);
      EXPECT_NEAR((J_parameters.col(k) - numeric).norm(), 0.0, 1e-3 * (1.0 + numeric.norm())) << k;
    }
  }
}

TEST_P(UnifiedCameraLaw, RefusesWhatItCannotSee)
{
  EXPECT_FALSE(camera.project({0.0, 0.0, 0.0}));
  EXPECT_FALSE(camera.project({0.0, 0.0, -1.0}));
  const double lowest = GetParam().xi <= 1.0 ? -GetParam().xi : -1.0 / GetParam().xi;
  const double z = lowest - 0.01;
  if (z > -1.0) {
    EXPECT_FALSE(camera.project({std::sqrt(1.0 - z * z), 0.0, z}));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sets, UnifiedCameraLaw,
    testing::Values(Parameters{0.0, 300, 310, 320, 240, 0, 0, 0, 0},
                    Parameters{0.5, 200, 200, 322, 238, 0, 0, 0, 0},
                    Parameters{0.95, 108, 108, 319.5, 239.5, 0, 0, 0, 0},
                    Parameters{1.0, 110, 112, 315, 245, 0.01, 0.001, 1e-3, -2e-3},
                    Parameters{1.3, 250, 255, 320, 240, -0.05, 0.002, 5e-4, 5e-4}));

// Expected pixels: the sphere model worked out by hand for an equatorial and a polar ray.
TEST(UnifiedCamera, MapsKnownRays)
{
  const UnifiedCamera camera({0.8, 100, 100, 320, 240, 0, 0, 0, 0}, 640, 480);
  const auto pole = camera.project({0, 0, 2});
  ASSERT_TRUE(pole);
  EXPECT_NEAR((*pole - Eigen::Vector2d(320, 240)).norm(), 0.0, 1e-12);
  const auto equator = camera.project({3, 0, 0});
  ASSERT_TRUE(equator);
  EXPECT_NEAR(equator->x(), 320 + 100 / 0.8, 1e-9);
}

TEST(UnifiedCamera, RefusesImpossibleParameters)
{
  EXPECT_THROW(UnifiedCamera({-0.1, 100, 100, 0, 0}, 640, 480), LogicError);
  EXPECT_THROW(UnifiedCamera({1.0, 0.0, 100, 0, 0}, 640, 480), LogicError);
  EXPECT_THROW(UnifiedCamera({1.0, 100, NAN, 0, 0}, 640, 480), LogicError);
  EXPECT_THROW(UnifiedCamera({1.0, 100, 100, 0, 0}, 0, 480), LogicError);
}

} // namespace
} // namespace homeward
