// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_views.h"

#include <homeward/calib/calibration.h>
#include <homeward/camera/unified_model.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

using testing::HasSubstr;

UnifiedModel mirror(double xi = 0.95)
{
  UnifiedCamera::Parameters p;
  p.xi = xi;
  p.fx = 110.0 * (1.0 + xi);
  p.fy = 110.0 * (1.0 + xi);
  p.cx = 643.5;
  p.cy = 476.5;
  return UnifiedModel(UnifiedCamera(p, 1280, 960));
}

BoardViews someViews(int count, std::uint64_t seed = 1)
{
  ViewPlan plan;
  plan.views = count;
  plan.leftHanded = true;
  return takeViews(mirror(), plan, seed);
}

std::string refusal(const BoardViews &views, const CalibrationOptions &options = {})
{
  try {
    calibrate(views, options);
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return "accepted";
}

std::string warnings(const Calibration &calibration)
{
  std::string all;
  for (const std::string &warning : calibration.warnings) {
    all += warning + "\n";
  }
  return all;
}

TEST(Refusals, TooFewViewsAreTooFew)
{
  EXPECT_THAT(refusal({1280, 960, {}}), HasSubstr("0 of 0 views"));
  EXPECT_THAT(refusal({1280, 960, {}}), HasSubstr("take ten or more"));
  EXPECT_THAT(refusal(someViews(1)), HasSubstr("1 of 1 views"));
  EXPECT_THAT(refusal(someViews(2)), HasSubstr("at least three"));
}

TEST(Refusals, ViewsThatAreAllAlikeSayWhatToDo)
{
  const UnifiedModel camera = mirror();
  BoardViews views = someViews(1);
  const BoardView first = views.views[0];
  Random random(2, 0);
  for (int i = 0; i < 9; ++i) {
    views.views.push_back(first);
    for (Eigen::Vector2d &pixel : views.views.back().pixels) {
      pixel += Eigen::Vector2d(random.normal(0.1), random.normal(0.1));
    }
  }
  const std::string message = refusal(views);
  EXPECT_THAT(message, testing::AnyOf(HasSubstr("alike"), HasSubstr("do not determine"),
                                      HasSubstr("no camera explains")));
  EXPECT_THAT(message, testing::AnyOf(HasSubstr("tilt")));
}

TEST(Refusals, PointsInNoOrderSayWhatToCheck)
{
  BoardViews views = someViews(6);
  Random random(3, 0);
  for (BoardView &view : views.views) {
    for (std::size_t i = view.pixels.size() - 1; i > 0; --i) {
      std::swap(view.pixels[i], view.pixels[random.bits() % (i + 1)]);
    }
  }
  EXPECT_THAT(refusal(views), HasSubstr("order of"));
}

TEST(Refusals, AnotherModelIsNamed)
{
  CalibrationOptions options;
  options.model = "pinhole";
  EXPECT_THAT(refusal(someViews(5), options), HasSubstr("'pinhole'"));
}

TEST(Refusals, NumbersThatAreNoneAreTheCallersFault)
{
  BoardViews views = someViews(5);
  views.views[2].pixels[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(calibrate(views), LogicError);
  views = someViews(5);
  views.views[2].pixels.pop_back();
  EXPECT_THROW(calibrate(views), LogicError);
  views = someViews(5);
  views.width = 0;
  EXPECT_THROW(calibrate(views), LogicError);
}

TEST(Refusals, OneViewOfNothingIsLeftOutByName)
{
  BoardViews views = someViews(6);
  const Eigen::VectorXd without = calibrate(views).model->parameters();
  BoardView few = views.views[0];
  few.name = "few.png";
  few.pixels.resize(4);
  few.board.resize(4);
  few.ids.resize(4);
  views.views.insert(views.views.begin() + 2, few);
  const Calibration found = calibrate(views);
  EXPECT_THAT(warnings(found), HasSubstr("few.png is left out"));
  EXPECT_EQ(found.views.size(), 7U);
  EXPECT_EQ(found.views[2].outliers, std::vector<bool>(4, true));
  EXPECT_EQ(found.model->parameters(), without);
}

TEST(Refusals, OneShuffledViewIsLeftOutByName)
{
  BoardViews views = someViews(8);
  const Eigen::VectorXd p = calibrate(views).model->parameters();
  BoardView &bad = views.views[3];
  bad.name = "bad.png";
  std::rotate(bad.pixels.begin(), bad.pixels.begin() + 7, bad.pixels.end());
  const Calibration found = calibrate(views);
  EXPECT_THAT(warnings(found), HasSubstr("bad.png is left out"));
  EXPECT_NEAR(found.model->parameters()[0], p[0], 0.01);
}

// A chessboard found upside down is the same board turned; found in a mirror it is its back.
TEST(Boards, UpsideDownOrMirroredFitAllTheSame)
{
  const BoardViews views = someViews(8);
  const Calibration plain = calibrate(views);
  EXPECT_TRUE(plain.mirrored);

  BoardViews turned = views;
  for (Eigen::Vector3d &point : turned.views[1].board) {
    point = Eigen::Vector3d(0.4 - point.x(), 0.25 - point.y(), 0.0);
  }
  const Calibration upsideDown = calibrate(turned);
  EXPECT_NEAR(upsideDown.robustRms, plain.robustRms, 1e-6);
  EXPECT_NEAR(upsideDown.model->parameters()[0], plain.model->parameters()[0], 1e-5);
  EXPECT_THAT(warnings(upsideDown), testing::Not(HasSubstr("other way round")));

  BoardViews flipped = views;
  flipped.views[1].name = "flipped.png";
  for (Eigen::Vector3d &point : flipped.views[1].board) {
    point.x() = 0.4 - point.x();
  }
  const Calibration back = calibrate(flipped);
  EXPECT_NEAR(back.robustRms, plain.robustRms, 1e-6);
  EXPECT_THAT(warnings(back), HasSubstr("the other way round in flipped.png"));
}

TEST(Warnings, SayWhereNoViewIs)
{
  ViewPlan plan;
  plan.views = 40;
  plan.lowest = -60;
  plan.highest = -45;
  BoardViews low = takeViews(mirror(), plan, 4);
  for (BoardView &view : low.views) {
    BoardView inner{view.name, {}, {}, {}};
    for (std::size_t i = 0; i < view.pixels.size(); ++i) {
      if ((view.pixels[i] - Eigen::Vector2d(643.5, 476.5)).norm() < 300.0) {
        inner.ids.push_back(view.ids[i]);
        inner.board.push_back(view.board[i]);
        inner.pixels.push_back(view.pixels[i]);
      }
    }
    view = inner;
  }
  EXPECT_THAT(warnings(calibrate(low)), HasSubstr("no view near the rim"));

  BoardViews side = someViews(30);
  std::vector<BoardView> kept;
  for (const BoardView &view : side.views) {
    if (std::all_of(view.pixels.begin(), view.pixels.end(),
                    [](const Eigen::Vector2d &pixel) { return pixel.x() > 660.0; })) {
      kept.push_back(view);
    }
  }
  side.views = kept;
  ASSERT_GE(side.views.size(), 5U);
  EXPECT_THAT(warnings(calibrate(side)), HasSubstr("all round the mirror"));
  EXPECT_EQ(warnings(calibrate(someViews(15))), "");
}

// Three views lie low and one high: without that one nothing is known up there.
TEST(Warnings, NameTheViewThatStandsAlone)
{
  UnifiedCamera::Parameters p = mirror(0.8).camera().parameters();
  p.k1 = -0.05;
  p.k2 = 0.01;
  const UnifiedModel bent(UnifiedCamera(p, 1280, 960));
  ViewPlan plan;
  plan.views = 4;
  plan.noise = 0.4;
  plan.lowest = -60;
  plan.highest = -40;
  BoardViews views = takeViews(bent, plan, 3);
  plan.views = 1;
  plan.lowest = 25;
  plan.highest = 30;
  views.views.push_back(takeViews(bent, plan, 4).views.front());
  views.views.back().name = "high.png";
  const Calibration found = calibrate(views);
  EXPECT_THAT(warnings(found), HasSubstr("rests on high.png alone"));
  EXPECT_TRUE(std::isfinite(*found.heldoutRms));
}

// e = (1 + sqrt(1 - xi^2)) / xi of a hyperbola: xi 0.8 is e 2, xi 1 a parabola.
TEST(Warnings, XiIsThatOfAMirror)
{
  ViewPlan plan;
  const Calibration hyperbola = calibrate(takeViews(mirror(0.8), plan, 5));
  ASSERT_TRUE(hyperbola.mirrorEccentricity);
  EXPECT_NEAR(*hyperbola.mirrorEccentricity, 2.0, 0.02);
  const Calibration beyond = calibrate(takeViews(mirror(1.3), plan, 5));
  EXPECT_FALSE(beyond.mirrorEccentricity);
  EXPECT_THAT(warnings(beyond), HasSubstr("more than 1, which no mirror"));
}

} // namespace
} // namespace homeward
