// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/homing/min_warping.h>

#include <gtest/gtest.h>

#include <vector>

namespace homeward
{
namespace
{

/** Mean direction error over a fixed set of pairs, degrees. */
double meanError(const MinWarping &method, const SyntheticRoom &room, const RoomLight &light)
{
  Random random(8, 0);
  double sum = 0.0;
  constexpr int kPairs = 12;
  for (int i = 0; i < kPairs; ++i) {
    const Pose2 home{random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5), 0.0};
    const double away = random.uniform(-kPi, kPi);
    const double distance = 0.3 + 0.1 * i;
    const Pose2 current{home.x + distance * std::cos(away), home.y + distance * std::sin(away),
                        random.uniform(-kPi, kPi)};
    const std::optional<WarpingMatch> match =
        method.match(method.prepare(room.view(current, light)), method.prepare(room.view(home)));
    sum += match ? std::abs(wrapAngle(match->home.direction - trueDirection(current, home))) : kPi;
  }
  return degrees(sum / kPairs);
}

TEST(MinWarping, holdsUnderChangedLight)
{
  const SyntheticRoom room(21, 6.0, 5.0);
  const MinWarping method;
  const std::vector<RoomLight> lights{
      {.gain = 0.3}, {.gain = 0.8, .offset = 30.0}, {.gain = 0.5, .slope = 0.6, .from = 1.0}};
  for (const RoomLight &light : lights) {
    EXPECT_LT(meanError(method, room, light), 4.0)
        << "gain " << light.gain << " offset " << light.offset << " slope " << light.slope;
  }
}

TEST(MinWarping, fewerColumnsAndOneSearchStillPointHome)
{
  const SyntheticRoom room(21, 6.0, 5.0);
  EXPECT_LT(meanError(MinWarping({.columns = 72}), room, {}), 6.0);
  EXPECT_LT(meanError(MinWarping({.doubleSearch = false}), room, {}), 6.0);
}

TEST(MinWarping, aCoarserSearchOverFineColumnsPointsHome)
{
  const SyntheticRoom room(21, 6.0, 5.0);
  EXPECT_LT(meanError(MinWarping({.columns = 144, .searchStep = 2}), room, {}), 4.0);
  EXPECT_LT(meanError(MinWarping({.columns = 288, .searchStep = 3}), room, {.gain = 0.4}), 4.0);
  EXPECT_THROW(MinWarping({.searchStep = 5}), LogicError);
  EXPECT_THROW(MinWarping({.searchStep = 0}), LogicError);
}

TEST(MinWarping, thoroughSettingIsMoreAccurate)
{
  const SyntheticRoom room(21, 6.0, 5.0);
  const RoomLight evening{.gain = 0.4, .slope = 0.5};
  EXPECT_LT(meanError(MinWarping(kThoroughWarping), room, evening),
            0.7 * meanError(MinWarping(), room, evening));
}

TEST(MinWarping, otherPlaceIsFarAndUnsure)
{
  const SyntheticRoom here(21, 6.0, 5.0);
  const SyntheticRoom there(22, 6.0, 5.0);
  const MinWarping method;
  const ColumnFeatures home = method.prepare(here.view({}));
  const std::optional<WarpingMatch> near =
      method.match(method.prepare(here.view({0.8, 0.3, 2.0}, {.gain = 0.4})), home);
  const std::optional<WarpingMatch> far =
      method.match(method.prepare(there.view({0.8, 0.3, 2.0})), home);
  ASSERT_TRUE(near && far);
  EXPECT_LT(near->matchDistance + 0.05, far->matchDistance);
  EXPECT_GT(near->home.confidence, 0.3);
  EXPECT_LT(far->home.confidence, 0.1);
}

TEST(MinWarping, samePictureMatchesWithoutRest)
{
  const SyntheticRoom room(21, 6.0, 5.0);
  const MinWarping method;
  const ColumnFeatures home = method.prepare(room.view({}));
  const std::optional<WarpingMatch> match = method.match(home, home);
  ASSERT_TRUE(match);
  EXPECT_DOUBLE_EQ(match->matchDistance, 0.0);
  EXPECT_GT(match->home.confidence, 0.95);
}

TEST(MinWarping, swappingTheViewsSwapsTheRoles)
{
  // Exact on the grid of the double search; the sub-column refinement sees slightly different sums.
  const SyntheticRoom room(21, 6.0, 5.0);
  const MinWarping method;
  const ColumnFeatures a = method.prepare(room.view({0.0, 0.0, 0.4}));
  const ColumnFeatures b = method.prepare(room.view({0.7, -0.4, 1.5}));
  const std::optional<WarpingMatch> there = method.match(b, a);
  const std::optional<WarpingMatch> back = method.match(a, b);
  ASSERT_TRUE(there && back);
  EXPECT_DOUBLE_EQ(there->matchDistance, back->matchDistance);
  EXPECT_NEAR(wrapAngle(there->home.headingChange + back->home.headingChange), 0.0, radians(0.5));
  // Home from a, in a's frame, is opposite to home from b turned into a's frame.
  EXPECT_NEAR(
      wrapAngle(back->home.direction - there->home.direction - there->home.headingChange - kPi),
      0.0, radians(2.5));
}

TEST(MinWarping, panoramasOfOtherSizesCompare)
{
  const SyntheticRoom room(21, 6.0, 5.0);
  const PanoramaGeometry coarse{.width = 500, .height = 120};
  const Pose2 home{0.0, 0.0, 0.0};
  const Pose2 current{0.6, 0.5, 1.0};
  MinWarping method;
  const std::optional<HomeVector> found =
      method.compute(room.view(current, {}, coarse), room.view(home));
  ASSERT_TRUE(found);
  EXPECT_NEAR(wrapAngle(found->direction - trueDirection(current, home)), 0.0, radians(5.0));
}

TEST(MinWarping, refusesWhatItCannotSearch)
{
  EXPECT_THROW(MinWarping({.columns = 143}), LogicError);
  EXPECT_THROW(MinWarping({.columns = 362}), LogicError);
  EXPECT_THROW(MinWarping({.rows = 4}), LogicError);
  EXPECT_THROW(MinWarping({.planes = 8}), LogicError);
  EXPECT_THROW(MinWarping({.scaleMax = 1.0}), LogicError);
  EXPECT_THROW(MinWarping({.scaleLimit = 1.5}), LogicError);
  EXPECT_THROW(MinWarping({.compassShare = 0.0}), LogicError);
  const SyntheticRoom room(21, 6.0, 5.0);
  const ColumnFeatures other = MinWarping({.columns = 72}).prepare(room.view({}));
  EXPECT_THROW(MinWarping().match(other, other), LogicError);
  const PanoramaGeometry floorOnly{.elevationMin = radians(-60.0), .elevationMax = radians(-5.0)};
  EXPECT_THROW(MinWarping().prepare(room.view({}, {}, floorOnly)), LogicError);
}

} // namespace
} // namespace homeward
