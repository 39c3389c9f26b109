// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_views.h"
#include "test_paths.h"

#include <homeward/calib/calibration.h>
#include <homeward/calib/radial_start.h>
#include <homeward/camera/unified_model.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>

#include <cmath>

namespace homeward
{
namespace
{

UnifiedModel mirror(double xi)
{
  UnifiedCamera::Parameters p;
  p.xi = xi;
  p.fx = 110.0 * (1.0 + xi);
  p.fy = 110.0 * (1.0 + xi);
  p.cx = 643.5;
  p.cy = 476.5;
  return UnifiedModel(UnifiedCamera(p, 1280, 960));
}

// The symmetry of the picture alone gives centre and poses: noise-free they are exact.
TEST(RadialStart, IsExactWithoutNoise)
{
  const UnifiedModel truth = mirror(0.9);
  ViewPlan plan;
  plan.views = 8;
  plan.noise = 0.0;
  const BoardViews views = takeViews(truth, plan, 1);
  const Eigen::Vector2d centre = radialCentre(views);
  EXPECT_NEAR(centre.x(), 643.5, 0.5);
  EXPECT_NEAR(centre.y(), 476.5, 0.5);
  for (const BoardView &view : views.views) {
    EXPECT_LT(radialPose(view, {643.5, 476.5})->rms, 1e-6);
  }
  const auto start = radialStart(views, 0.9, 110.0 * 1.9, {643.5, 476.5});
  ASSERT_TRUE(start);
  EXPECT_LT(start->error, 1e-6);
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    for (std::size_t i = 0; i < views.views[v].board.size(); ++i) {
      const auto pixel = truth.project(start->cMo[v] * views.views[v].board[i]);
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - views.views[v].pixels[i]).norm(), 1e-4);
    }
  }
}

TEST(RadialStart, TheBestFocalLengthIsNearTheTrueOne)
{
  ViewPlan plan;
  plan.views = 8;
  const BoardViews views = takeViews(mirror(1.0), plan, 2);
  const auto starts = radialStarts(views, radialCentre(views), 3);
  ASSERT_FALSE(starts.empty());
  EXPECT_NEAR(starts.front().f / (1.0 + starts.front().xi), 110.0, 25.0);
  EXPECT_TRUE(
      std::is_sorted(starts.begin(), starts.end(),
                     [](const RadialStart &a, const RadialStart &b) { return a.error < b.error; }));
}

TEST(RadialStart, SaysNothingFromPointsOnALine)
{
  BoardView view;
  for (int i = 0; i < 9; ++i) {
    view.board.emplace_back(0.1 * i, 0.2 * i, 0.0);
    view.pixels.emplace_back(300.0 + 10.0 * i, 400.0);
  }
  EXPECT_FALSE(radialPose(view, {640, 480}));
}

/** Guesses: f up to three times too long or short, the centre up to 20 % of the picture off.
 */
void expectOneOptimum(const BoardViews &views, const Eigen::VectorXd &about, int starts)
{
  CalibrationOptions options;
  options.crossValidate = false;
  options.starts = 1;
  const Calibration reference = calibrate(views);
  Random random(3, 0);
  int refusals = 0;
  for (int i = 0; i < starts; ++i) {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(10);
    const double factor = std::pow(3.0, random.uniform(-1.0, 1.0));
    p << random.uniform(0.3, 1.8), about[1] * factor, about[2] * factor,
        about[3] + views.width * random.uniform(-0.2, 0.2),
        about[4] + views.height * random.uniform(-0.2, 0.2), 0, 0, 0, 0, 0;
    try {
      const Calibration found =
          calibrateFromStart(views, UnifiedModel(p, views.width, views.height), options);
      ASSERT_TRUE(found.model->parameters().allFinite());
      ASSERT_NEAR(found.robustRms, reference.robustRms, 1e-5) << p.transpose();
      for (Eigen::Index k = 0; k < 5; ++k) {
        ASSERT_NEAR(found.model->parameters()[k], reference.model->parameters()[k],
                    0.02 * std::sqrt(reference.covariance(k, k)))
            << k << " from " << p.transpose();
      }
    }
    catch (const ConfigError &) {
      ++refusals;
    }
  }
  EXPECT_EQ(refusals, 0);
}

TEST(RandomStarts, OfSyntheticViewsEndInOneOptimum)
{
  ViewPlan plan;
  plan.views = 5;
  plan.columns = 6;
  plan.rows = 5;
  plan.pitch = 0.08;
  plan.nearest = 0.15;
  plan.farthest = 0.3;
  const UnifiedModel truth = mirror(0.95);
  expectOneOptimum(takeViews(truth, plan, 3), truth.parameters(), 1000);
}

TEST(RandomStarts, OfRealViewsEndInOneOptimum)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("calibration/mirror_corners.csv");
  const BoardViews views =
      readCorners(outsideDataDir() / "calibration/mirror_corners.csv", 1280, 960);
  Eigen::VectorXd about = Eigen::VectorXd::Zero(10);
  about << 1.0, 410, 410, 630, 433, 0, 0, 0, 0, 0;
  expectOneOptimum(views, about, 200);
}

TEST(RandomStarts, OfAnotherModelOrSizeAreRefused)
{
  const BoardViews views{640, 480, {}};
  EXPECT_THROW(calibrateFromStart(views, mirror(0.9)), LogicError);
}

} // namespace
} // namespace homeward
