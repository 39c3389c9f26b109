// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_views.h"

#include <homeward/calib/calibration.h>
#include <homeward/calib/convert.h>
#include <homeward/camera/camera_models.h>
#include <homeward/camera/unified_model.h>
#include <homeward/core/random.h>

#include <gmock/gmock.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

/** f / (1 + xi), pixels: the scale along the axis. */
constexpr double kScale = 110.0;

UnifiedModel mirror(double xi, double k1 = 0.0, double p1 = 0.0)
{
  UnifiedCamera::Parameters p;
  p.xi = xi;
  p.fx = kScale * (1.0 + xi);
  p.fy = kScale * (1.0 + xi);
  p.cx = 643.5;
  p.cy = 476.5;
  p.k1 = k1;
  p.p1 = p1;
  return UnifiedModel(UnifiedCamera(p, 1280, 960));
}

/** A board of 64 x 40 cm held close round the mirror, often partly out of the picture. */
ViewPlan closePlan(int views)
{
  ViewPlan plan;
  plan.views = views;
  plan.pitch = 0.08;
  plan.nearest = 0.15;
  plan.farthest = 0.3;
  plan.lowest = -55.0;
  plan.highest = 35.0;
  return plan;
}

/** Largest angle between the rays of two models over the picture up to the rim, degrees. */
double largestRayError(const CameraModel &truth, const CameraModel &found)
{
  double largest = 0.0;
  for (const Eigen::Vector2d &pixel : pixelGrid(truth, 40.0, 475.0)) {
    const auto ray = truth.unproject(pixel);
    if (ray) {
      const auto other = found.unproject(pixel);
      const double cosine = other ? std::clamp(ray->dot(*other), -1.0, 1.0) : -1.0;
      largest = std::max(largest, degrees(std::acos(cosine)));
    }
  }
  return largest;
}

class KnownMirror : public testing::TestWithParam<std::tuple<double, int, int>>
{};

TEST_P(KnownMirror, IsFoundAgain)
{
  const auto [xi, count, seed] = GetParam();
  const UnifiedModel truth = mirror(xi);
  const BoardViews views = takeViews(truth, closePlan(count), static_cast<std::uint64_t>(seed));
  const auto partial = std::count_if(views.views.begin(), views.views.end(),
                                     [](const BoardView &view) { return view.pixels.size() < 54; });
  EXPECT_GE(partial, 2);
  const Calibration found = calibrate(views);
  const Eigen::VectorXd p = found.model->parameters();
  EXPECT_NEAR(p[1] / (1.0 + p[0]) / kScale, 1.0, 0.002);
  EXPECT_NEAR(p[2] / (1.0 + p[0]) / kScale, 1.0, 0.002);
  EXPECT_NEAR(p[3], 643.5, 0.002 * 1280);
  EXPECT_NEAR(p[4], 476.5, 0.002 * 960);
  EXPECT_LT(largestRayError(truth, *found.model), 0.05);
  // Three standard deviations of two numbers together: 99.7 %.
  const Eigen::Vector2d off(p[0] - xi, p[1] - kScale * (1.0 + xi));
  const Eigen::Matrix2d covariance = found.covariance.topLeftCorner<2, 2>();
  EXPECT_LT(off.dot(covariance.inverse() * off), 11.8);
  EXPECT_NEAR(found.robustRms, 0.1 * std::sqrt(2.0), 0.012);
  EXPECT_LT(*found.heldoutRms, 1.15 * found.robustRms);
  EXPECT_LE(found.outliers, 1);
}

INSTANTIATE_TEST_SUITE_P(Mirrors, KnownMirror,
                         testing::Combine(testing::Values(0.8, 0.95, 1.05), testing::Values(10, 20),
                                          testing::Values(3, 4, 5)));

/** Views as of a board that is bent a little, every time in another way. */
BoardViews bent(BoardViews views, std::uint64_t seed)
{
  constexpr double kShare = 5e-4;
  Random random(seed, 1);
  for (BoardView &view : views.views) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d &pixel : view.pixels) {
      middle += pixel / static_cast<double>(view.pixels.size());
    }
    const Eigen::Matrix2d bend{{random.normal(kShare), random.normal(kShare)},
                               {random.normal(kShare), random.normal(kShare)}};
    for (Eigen::Vector2d &pixel : view.pixels) {
      pixel += bend * (pixel - middle);
    }
  }
  return views;
}

// Errors that the points of a view share count once a view, not once a point.
TEST(SyntheticViews, SigmasHoldForViewsThatAreWrongAsAWhole)
{
  int inside = 0;
  constexpr int kRuns = 10;
  for (int run = 0; run < kRuns; ++run) {
    const auto seed = static_cast<std::uint64_t>(run);
    const Calibration found = calibrate(bent(takeViews(mirror(0.95), closePlan(15), seed), seed));
    const Eigen::VectorXd p = found.model->parameters();
    const Eigen::Vector2d off(p[0] - 0.95, p[1] - kScale * 1.95);
    const Eigen::Matrix2d covariance = found.covariance.topLeftCorner<2, 2>();
    inside += off.dot(covariance.inverse() * off) < 11.8 ? 1 : 0;
  }
  EXPECT_GE(inside, kRuns - 1);
}

TEST(SyntheticViews, DistortionIsFoundWhereItIsAndOnlyThere)
{
  const Calibration plain = calibrate(takeViews(mirror(0.95), closePlan(15), 4));
  EXPECT_THAT(std::vector<bool>(plain.estimated.begin() + 5, plain.estimated.end()),
              testing::Each(false));
  EXPECT_EQ(plain.model->parameters().tail<5>(), Eigen::VectorXd::Zero(5));

  const UnifiedModel bent = mirror(0.95, -0.05, 2e-3);
  const Calibration found = calibrate(takeViews(bent, closePlan(15), 4));
  EXPECT_TRUE(found.estimated[5]);
  EXPECT_TRUE(found.estimated[7]);
  EXPECT_LT(largestRayError(bent, *found.model), 0.15);
  EXPECT_NEAR(found.robustRms, 0.1 * std::sqrt(2.0), 0.012);
}

TEST(SyntheticViews, WrongPointsAreNamedAndDoNoHarm)
{
  const UnifiedModel truth = mirror(0.95);
  ViewPlan plan = closePlan(15);
  plan.outliers = 0.1;
  const BoardViews spoiled = takeViews(truth, plan, 5);
  const Calibration found = calibrate(spoiled);
  EXPECT_LT(largestRayError(truth, *found.model), 0.08);
  EXPECT_NEAR(found.robustRms, 0.1 * std::sqrt(2.0), 0.012);
  EXPECT_GT(found.rms, 3.0);
  // What is more than a pixel off is wrong, and nothing else.
  int named = 0;
  for (std::size_t v = 0; v < found.views.size(); ++v) {
    for (std::size_t i = 0; i < found.views[v].outliers.size(); ++i) {
      named += found.views[v].outliers[i] ? 1 : 0;
      const double off = found.views[v].residuals[i].norm();
      EXPECT_TRUE(found.views[v].outliers[i] ? off > 0.4 : off < 0.8) << v << " " << i;
    }
  }
  EXPECT_EQ(named, found.outliers);
  EXPECT_GT(named, 40);
}

TEST(SyntheticViews, ManyWrongPointsOrWrongMeasuresAreSaid)
{
  const auto warnings = [](const BoardViews &views) { return calibrate(views).warnings; };
  ViewPlan plan = closePlan(15);
  EXPECT_THAT(warnings(takeViews(mirror(0.95), plan, 5)), testing::IsEmpty());
  plan.outliers = 0.2;
  EXPECT_THAT(warnings(takeViews(mirror(0.95), plan, 5)),
              testing::Contains(testing::HasSubstr("not believed")));
  plan.outliers = 0.0;
  plan.noise = 0.5;
  EXPECT_THAT(warnings(takeViews(mirror(0.95), plan, 5)),
              testing::Contains(testing::HasSubstr("measures")));
}

// A flat board seen in a mirror has a proper pose all the same; only the side that shows differs.
TEST(SyntheticViews, AMirroredPictureIsToldFromAnUnmirroredOne)
{
  for (const bool leftHanded : {true, false}) {
    for (const double bend : {0.0, 0.03}) {
      const UnifiedModel truth = mirror(0.9);
      ViewPlan plan = closePlan(12);
      plan.leftHanded = leftHanded;
      plan.bend = bend;
      const BoardViews views = takeViews(truth, plan, 6);
      const Calibration found = calibrate(views);
      EXPECT_EQ(found.mirrored, leftHanded) << bend;
      EXPECT_NEAR(found.robustRms, 0.1 * std::sqrt(2.0), 0.012) << bend << leftHanded;
      for (std::size_t v = 0; v < found.views.size(); ++v) {
        const Eigen::Matrix3d R = found.views[v].cMo.linear();
        EXPECT_NEAR(R.determinant(), 1.0, 1e-9);
        Eigen::Vector3d point = views.views[v].board.front();
        point.z() *= found.mirrored ? -1.0 : 1.0;
        const auto pixel = found.model->project(found.views[v].cMo * point);
        ASSERT_TRUE(pixel);
        EXPECT_LT((*pixel - views.views[v].pixels.front()).norm(), 0.6);
      }
    }
  }
}

TEST(SyntheticViews, EveryModelFindsItself)
{
  const UnifiedModel truth = mirror(0.9);
  for (const std::string &name : cameraModelNames()) {
    const ModelFit made = fitModel(truth, name, pixelGrid(truth, 0.0, 475.0));
    const BoardViews views = takeViews(*made.model, closePlan(15), 7);
    CalibrationOptions options;
    options.model = name;
    const Calibration found = calibrate(views, options);
    EXPECT_NEAR(found.robustRms, 0.1 * std::sqrt(2.0), 0.012) << name;
    EXPECT_LT(largestRayError(*made.model, *found.model), 0.2) << name;
    EXPECT_LT(*found.heldoutRms, 1.15 * found.robustRms) << name;
  }
}

TEST(SyntheticViews, TheFocalLengthsAreKnownTogether)
{
  const Calibration found = calibrate(takeViews(mirror(0.95), closePlan(15), 4));
  const Eigen::MatrixXd correlations = found.correlations();
  const Eigen::MatrixXd &covariance = found.covariance;
  EXPECT_GT(correlations(1, 2), 0.7); // fx, fy: how far the boards were trades against both
  EXPECT_LT(std::abs(correlations(1, 3)), 0.5); // fx, cx
  EXPECT_DOUBLE_EQ(correlations(0, 1),
                   covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)));
  EXPECT_NEAR(correlations(4, 4), 1.0, 1e-12);
  EXPECT_EQ(correlations(5, 5), 0.0); // k1 is held
  EXPECT_LE(correlations.cwiseAbs().maxCoeff(), 1.0 + 1e-12);
}

TEST(SyntheticViews, SigmasAreWhatRepetitionShows)
{
  const UnifiedModel truth = mirror(0.95);
  constexpr int kRuns = 30;
  double sum = 0.0;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    CalibrationOptions options;
    options.crossValidate = false;
    const Calibration found = calibrate(takeViews(truth, closePlan(8), 100 + run), options);
    const Eigen::VectorXd off = (found.model->parameters() - truth.parameters()).head<5>();
    const Eigen::MatrixXd covariance = found.covariance.topLeftCorner<5, 5>();
    sum += off.dot(covariance.inverse() * off);
  }
  // Chi-square of five numbers: mean 5, standard deviation sqrt(10 / runs).
  EXPECT_NEAR(sum / kRuns, 5.0, 4.0 * std::sqrt(10.0 / kRuns));
}

} // namespace
} // namespace homeward
