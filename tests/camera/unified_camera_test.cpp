// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/unified_camera.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace homeward
{
namespace
{

using Parameters = UnifiedCamera::Parameters;

/** What xi alone decides, from a pinhole to beyond a parabola; the laws of all models are in
 * camera_model_test.cpp. */
class UnifiedCameraLaw : public testing::TestWithParam<Parameters>
{
protected:
  UnifiedCamera camera{GetParam(), 640, 480};
};

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
                    Parameters{1.3, 250, 255, 320, 240, -0.05, 0.002, 5e-4, 5e-4},
                    Parameters{1.3, 250, 250, 320, 240, 0, 0, 0, 0},
                    Parameters{0.95, 60, 60, 320, 240, 0.3, -0.05, 0, 0}));

// The radial polynomial of the last set turns back at |m| = 2.12: no ray, rather than a wrong one.
TEST(UnifiedCamera, HasNoRayWhereThePolynomialEnds)
{
  const UnifiedCamera camera({0.95, 60, 60, 320, 240, 0.3, -0.05, 0, 0}, 640, 480);
  const double s = 4.5231;
  const double end = std::sqrt(s) * (1.0 + 0.3 * s - 0.05 * s * s);
  EXPECT_TRUE(camera.unproject({320.0 + 60.0 * (end - 1e-3), 240.0}));
  EXPECT_FALSE(camera.unproject({320.0 + 60.0 * (end + 1e-3), 240.0}));
  const auto ray = camera.unproject({320.0, 240.0 - 60.0 * 2.5});
  ASSERT_TRUE(ray);
  EXPECT_NEAR(camera.project(*ray)->y(), 240.0 - 60.0 * 2.5, 1e-7);
}

/**
 * Traces a camera ray to the mirror r(z) whose foci are the origin and (0, 0, d), by bisection on
 * the hyperbola's own definition |P - F'| - |P - F| = 2 a, and reflects it by the law of optics.
 */
Eigen::Vector3d reflected(const Eigen::Vector3d &fromEye, double d, double a)
{
  const Eigen::Vector3d eye(0.0, 0.0, d);
  const auto value = [&](const Eigen::Vector3d &p) {
    return (p - eye).norm() - p.norm() - 2.0 * a;
  };
  double near = 0.0;
  double far = 1.0;
  while (value(eye + far * fromEye) < 0.0 && far < 1e4) {
    far *= 1.2;
  }
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (near + far);
    (value(eye + middle * fromEye) < 0.0 ? near : far) = middle;
  }
  const Eigen::Vector3d p = eye + far * fromEye;
  const Eigen::Vector3d normal = ((p - eye).normalized() - p.normalized()).normalized();
  return fromEye - 2.0 * fromEye.dot(normal) * normal;
}

// \cite Mei2007: a hyperbola of foci d and vertices 2 a apart has xi = 4 a d / (d^2 + 4 a^2) and a
// focal length reduced by (d^2 - 4 a^2) / (d^2 + 4 a^2).
TEST(UnifiedCamera, IsWhatAHyperbolicMirrorReflects)
{
  const double d = 0.12;
  for (const double a : {0.02, 0.035, 0.05}) {
    const double sum = d * d + 4.0 * a * a;
    const double f = 400.0;
    const double reduced = f * (d * d - 4.0 * a * a) / sum;
    int hits = 0;
    const UnifiedCamera camera({4.0 * a * d / sum, reduced, reduced, 320, 240}, 640, 480);
    for (double v = 10.0; v < 480.0; v += 47.0) {
      for (double u = 10.0; u < 640.0; u += 47.0) {
        // The lens looks up, against z; columns along x, rows along y.
        const Eigen::Vector3d eyeRay((u - 320.0) / f, (v - 240.0) / f, -1.0);
        if (-eyeRay.normalized().z() < 2.0 * a / d + 0.01) {
          continue; // passes the mirror, however large it is
        }
        ++hits;
        const Eigen::Vector3d seen = reflected(eyeRay.normalized(), d, a);
        const auto ray = camera.unproject({u, v});
        ASSERT_TRUE(ray);
        EXPECT_NEAR((*ray - seen).norm(), 0.0, 1e-6) << a << " " << u << " " << v;
      }
    }
    EXPECT_GT(hits, 80);
  }
}

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
