// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/camera_models.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

/** A model with parameters; the picture is 640 x 480. */
struct Case
{
  const char *model;
  std::vector<double> parameters;
};

std::unique_ptr<CameraModel> make(const Case &from)
{
  const auto count = static_cast<Eigen::Index>(from.parameters.size());
  return makeCameraModel(
      from.model, Eigen::Map<const Eigen::VectorXd>(from.parameters.data(), count), 640, 480);
}

Eigen::Vector3d randomRay(Random &random)
{
  const double z = random.uniform(-1.0, 1.0);
  const double angle = random.uniform(-3.14, 3.14);
  const double s = std::sqrt(1.0 - z * z);
  return {s * std::cos(angle), s * std::sin(angle), z};
}

/** The laws every camera model obeys. */
class CameraModelLaw : public testing::TestWithParam<Case>
{
protected:
  std::unique_ptr<CameraModel> camera = make(GetParam());
};

TEST_P(CameraModelLaw, UnprojectInvertsProject)
{
  Random random(1, 0);
  int valid = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d ray = randomRay(random);
    const auto pixel = camera->project(ray * random.uniform(0.1, 50.0));
    // Far outside the picture the models are steep and their inverse of no use.
    if (!pixel || (*pixel - Eigen::Vector2d(320, 240)).norm() > 1500.0) {
      continue;
    }
    ++valid;
    const auto back = camera->unproject(*pixel);
    ASSERT_TRUE(back) << ray.transpose();
    EXPECT_NEAR((*back - ray).norm(), 0.0, 1e-7) << ray.transpose();
  }
  EXPECT_GT(valid, 300);
}

TEST_P(CameraModelLaw, ProjectInvertsUnproject)
{
  int valid = 0;
  for (int v = 0; v < 480; v += 20) {
    for (int u = 0; u < 640; u += 20) {
      const Eigen::Vector2d pixel(u, v);
      const auto ray = camera->unproject(pixel);
      if (!ray) {
        continue;
      }
      ++valid;
      EXPECT_NEAR(ray->norm(), 1.0, 1e-12);
      const auto back = camera->project(*ray);
      ASSERT_TRUE(back) << pixel.transpose();
      EXPECT_NEAR((*back - pixel).norm(), 0.0, 1e-6);
    }
  }
  EXPECT_GT(valid, 100);
}

TEST_P(CameraModelLaw, PointJacobianEqualsNumericDifferences)
{
  Random random(2, 0);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d point = randomRay(random) * random.uniform(0.5, 5.0);
    CameraModel::PointJacobian J_point;
    const auto pixel = camera->project(point, &J_point);
    if (!pixel || pixel->norm() > 3000.0) {
      continue;
    }
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d h = kStep * Eigen::Vector3d::Unit(k);
      const auto plus = camera->project(point + h);
      const auto minus = camera->project(point - h);
      if (!plus || !minus) {
        continue;
      }
      ++compared;
      const Eigen::Vector2d numeric = (*plus - *minus) / (2.0 * kStep);
      EXPECT_NEAR((J_point.col(k) - numeric).norm(), 0.0, 1e-5 * (1.0 + numeric.norm())) << k;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST_P(CameraModelLaw, ParameterJacobianEqualsNumericDifferences)
{
  const Eigen::Vector3d points[] = {
      {0.3, 0.2, 0.9}, {-1.0, 0.5, 0.8}, {0.4, -0.9, 0.7}, {0.0, 0.0, 2.0}, {1e-9, 0.0, 1.0}};
  const Eigen::VectorXd values = camera->parameters();
  for (const Eigen::Vector3d &point : points) {
    CameraModel::ParameterJacobian J_parameters;
    ASSERT_TRUE(camera->project(point, nullptr, &J_parameters));
    ASSERT_EQ(J_parameters.cols(), values.size());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      // One-sided where a parameter stands at its bound; small terms take small steps.
      const bool atBound = values[k] == 0.0 && camera->parameterNames()[std::size_t(k)] == "xi";
      const double step = camera->name() == "ocam" && k < values.size() - 5
                              ? std::pow(240.0, -static_cast<double>(k == 0 ? 0 : k + 1)) * 1e-3
                              : 1e-6;
      Eigen::VectorXd plus = values;
      Eigen::VectorXd minus = values;
      plus[k] += step;
      minus[k] -= atBound ? 0.0 : step;
      const Eigen::Vector2d numeric =
          (*camera->with(plus)->project(point) - *camera->with(minus)->project(point)) /
          (plus[k] - minus[k]);
      const double tolerance = 1e-3 * (1.0 + numeric.norm());
      EXPECT_NEAR((J_parameters.col(k) - numeric).norm(), 0.0, tolerance) << k;
    }
  }
}

TEST_P(CameraModelLaw, JacobiansAreWhatTheyAreAlone)
{
  const Eigen::Vector3d point(0.4, -0.9, 0.7);
  CameraModel::PointJacobian J_both;
  CameraModel::PointJacobian J_alone;
  CameraModel::ParameterJacobian J_parameters;
  const auto pixel = camera->project(point);
  EXPECT_EQ(*camera->project(point, &J_both, &J_parameters), *pixel);
  EXPECT_EQ(*camera->project(point, &J_alone), *pixel);
  EXPECT_EQ(J_both, J_alone);
}

TEST_P(CameraModelLaw, IsNeverNotANumber)
{
  Random random(3, 0);
  CameraModel::PointJacobian J_point;
  CameraModel::ParameterJacobian J_parameters;
  const double values[] = {0.0, -1.0, 1.0, 1e-300, -1e-12, 1e-12, 1e150, -1e8};
  for (const double x : values) {
    for (const double y : values) {
      for (const double z : values) {
        if (const auto pixel = camera->project({x, y, z}, &J_point, &J_parameters)) {
          EXPECT_TRUE(pixel->allFinite()) << x << " " << y << " " << z;
          EXPECT_FALSE(J_parameters.hasNaN()) << x << " " << y << " " << z;
          EXPECT_FALSE(J_point.hasNaN()) << x << " " << y << " " << z;
        }
      }
    }
  }
  for (int i = 0; i < 5000; ++i) {
    const double far = std::pow(10.0, random.uniform(0.0, 6.0));
    const Eigen::Vector2d pixel(random.uniform(-far, far), random.uniform(-far, far));
    if (const auto ray = camera->unproject(pixel)) {
      EXPECT_NEAR(ray->norm(), 1.0, 1e-12) << pixel.transpose();
    }
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(camera->project({kNaN, 0.0, 1.0}));
  EXPECT_FALSE(camera->project({0.0, 1.0, kNaN}));
  EXPECT_FALSE(camera->unproject({kNaN, 0.0}));
}

// Away from the axis the radius grows up to the border of the domain, and there is nothing behind.
TEST_P(CameraModelLaw, TheDomainIsOneCapAndTheRadiusGrowsInIt)
{
  const auto centre = camera->project(Eigen::Vector3d::UnitZ());
  ASSERT_TRUE(centre);
  double radius = 0.0;
  bool inside = true;
  for (double angle = 0.01; angle < 3.14; angle += 0.01) {
    const auto pixel = camera->project({std::sin(angle), 0.0, std::cos(angle)});
    EXPECT_FALSE(pixel && !inside) << "seen again at " << angle;
    inside = inside && pixel;
    if (pixel) {
      EXPECT_GT((*pixel - *centre).norm(), radius) << angle;
      radius = (*pixel - *centre).norm();
    }
  }
  EXPECT_FALSE(camera->project({0.0, 0.0, 0.0}));
  EXPECT_FALSE(camera->project({0.0, 0.0, -1.0}));
}

TEST_P(CameraModelLaw, RefusesParametersThatAreNone)
{
  const Eigen::VectorXd values = camera->parameters();
  EXPECT_EQ(camera->parameterNames().size(), static_cast<std::size_t>(values.size()));
  EXPECT_EQ(camera->with(values)->parameters(), values);
  EXPECT_THROW(camera->with(Eigen::VectorXd(values.head(3))), LogicError);
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    Eigen::VectorXd bad = values;
    bad[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(camera->with(bad), LogicError) << k;
  }
  EXPECT_THROW(makeCameraModel(camera->name(), values, 0, 480), LogicError);
}

INSTANTIATE_TEST_SUITE_P(
    Unified, CameraModelLaw,
    testing::Values(Case{"unified", {0.0, 300, 310, 320, 240, 0, 0, 0, 0, 0}},
                    Case{"unified", {0.5, 200, 200, 322, 238, 0, 0, 0, 0, 0.7}},
                    Case{"unified", {0.95, 108, 108, 319.5, 239.5, 0, 0, 0, 0, 0}},
                    Case{"unified", {1.0, 110, 112, 315, 245, 0.01, 0.001, 1e-3, -2e-3, -0.3}},
                    Case{"unified", {1.3, 250, 255, 320, 240, -0.05, 0.002, 5e-4, 5e-4, 0}},
                    Case{"unified", {1.3, 250, 250, 320, 240, 0, 0, 0, 0, 0}},
                    Case{"unified", {0.95, 60, 60, 320, 240, 0.3, -0.05, 0, 0, 0}}));

INSTANTIATE_TEST_SUITE_P(ExtendedUnified, CameraModelLaw,
                         testing::Values(Case{"extended_unified", {0.3, 1.0, 60, 61, 320, 240}},
                                         Case{"extended_unified", {0.5, 1.1, 55, 55, 320, 240}},
                                         Case{"extended_unified", {0.62, 0.9, 70, 70, 322, 238}}));

INSTANTIATE_TEST_SUITE_P(DoubleSphere, CameraModelLaw,
                         testing::Values(Case{"double_sphere", {-0.2, 0.55, 80, 81, 320, 240}},
                                         Case{"double_sphere", {0.4, 0.3, 80, 81, 320, 240}},
                                         Case{"double_sphere", {0.9, 0.1, 100, 100, 322, 238}},
                                         Case{"double_sphere", {0.3, 0.7, 90, 90, 320, 240}}));

INSTANTIATE_TEST_SUITE_P(
    KannalaBrandt, CameraModelLaw,
    testing::Values(Case{"kannala_brandt", {0, 0, 0, 0, 100, 100, 320, 240}},
                    Case{"kannala_brandt", {0.05, -0.01, 0.002, 0, 90, 91, 322, 238}},
                    Case{"kannala_brandt", {-0.06, 0.003, -0.002, 1e-4, 150, 150, 320, 240}}));

INSTANTIATE_TEST_SUITE_P(
    Ocam, CameraModelLaw,
    testing::Values(Case{"ocam", {110, -2.1e-3, 0, 0, 1, 0, 0, 320, 240}},
                    Case{"ocam", {120, -1.5e-3, -2e-6, -3e-9, 0.999, 1e-3, -2e-3, 322, 238}},
                    Case{"ocam", {100, -3e-3, 1e-6, 1, 0, 0, 320, 240}}));

TEST(CameraModels, OfAnotherNameThereIsNone)
{
  EXPECT_THROW(makeCameraModel("pinhole", Eigen::VectorXd::Ones(4), 640, 480), LogicError);
  EXPECT_EQ(cameraModelNames().size(), 5U);
}

// The unified model is an extended one: alpha = xi / (1 + xi), beta = 1, f / (1 + xi).
TEST(CameraModels, TheUnifiedModelIsAnExtendedOne)
{
  const auto unified = make({"unified", {0.8, 180, 180, 320, 240, 0, 0, 0, 0, 0}});
  const auto extended = make({"extended_unified", {0.8 / 1.8, 1.0, 100, 100, 320, 240}});
  const auto sphere = make({"double_sphere", {0.8, 0.0, 100 * 1.8, 180, 320, 240}});
  Random random(4, 0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d ray = randomRay(random);
    const auto pixel = unified->project(ray);
    const auto same = extended->project(ray);
    const auto again = sphere->project(ray);
    EXPECT_EQ(bool(pixel), bool(same));
    EXPECT_EQ(bool(pixel), bool(again));
    if (pixel && same && again) {
      EXPECT_NEAR((*pixel - *same).norm(), 0.0, 1e-9 * pixel->norm());
      EXPECT_NEAR((*pixel - *again).norm(), 0.0, 1e-9 * pixel->norm());
    }
  }
}

} // namespace
} // namespace homeward
