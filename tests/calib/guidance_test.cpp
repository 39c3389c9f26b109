// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/guidance.h>
#include <homeward/calib/target.h>
#include <homeward/core/angle.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;

const MirrorCircles kMirror{{{640.0, 480.0}, 90.0}, {{640.0, 480.0}, 450.0}};

/** A board round `azimuth`, drawn at a distance from the middle, `scale` pixels a pitch. */
BoardView boardAt(double azimuth, double radius, double scale, double slant = 0.0)
{
  BoardView view;
  const Target target;
  const auto points = targetPoints(target);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p = points[i].head<2>() / target.pitch - Eigen::Vector2d(4.0, 2.5);
    view.ids.push_back(static_cast<int>(i));
    view.board.push_back(points[i]);
    view.pixels.emplace_back(kMirror.outer.centre +
                             radius * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)) +
                             scale * p / (1.0 + slant * p.x()));
  }
  return view;
}

TEST(Guidance, asksForABoardFirst)
{
  EXPECT_THAT(guide({1280, 960, {}}, kMirror).sentence, HasSubstr("Hold the board"));
}

TEST(Guidance, asksForALargerBoard)
{
  const BoardViews views{1280, 960, {boardAt(0.0, 250.0, 8.0), boardAt(1.0, 250.0, 8.0)}};
  EXPECT_THAT(guide(views, kMirror).sentence, HasSubstr("nearer"));
}

TEST(Guidance, asksForTheRim)
{
  const BoardViews views{
      1280, 960, {boardAt(0.0, 250.0, 25.0), boardAt(1.0, 250.0, 25.0), boardAt(2.0, 250.0, 25.0)}};
  EXPECT_THAT(guide(views, kMirror).sentence, HasSubstr("rim"));
}

TEST(Guidance, asksForTilt)
{
  BoardViews views{1280, 960, {}};
  for (int i = 0; i < 6; ++i) {
    views.views.push_back(boardAt(i, i % 2 == 0 ? 350.0 : 200.0, 25.0));
  }
  EXPECT_THAT(guide(views, kMirror).sentence, HasSubstr("Tilt the board towards the rim"));
}

TEST(Guidance, namesTheSideThatIsMissingAsDisplayed)
{
  BoardViews views{1280, 960, {}};
  for (int i = 0; i < 8; ++i) {
    if (i != 2) { // straight down in the picture
      views.views.push_back(
          boardAt(radians(45.0 * i), i % 2 == 0 ? 350.0 : 200.0, 25.0, i % 3 == 0 ? 0.06 : -0.06));
    }
  }
  EXPECT_THAT(guide(views, kMirror).sentence, HasSubstr("at the bottom of the picture"));
  EXPECT_FALSE(guide(views, kMirror).enough);
}

TEST(Guidance, knowsWhenItIsEnough)
{
  BoardViews views{1280, 960, {}};
  for (int i = 0; i < 12; ++i) {
    views.views.push_back(
        boardAt(radians(30.0 * i), i % 2 == 0 ? 350.0 : 200.0, 25.0, i % 3 == 0 ? 0.06 : -0.06));
  }
  EXPECT_TRUE(guide(views, kMirror).enough) << guide(views, kMirror).sentence;
}

} // namespace
} // namespace homeward
