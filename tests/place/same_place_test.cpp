// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/same_place.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** What views 5 cm, 0.6 m and 3 m apart give in a room; typical numbers by day. */
constexpr PairLook kThere{0.10, 0.003, 0.35, 0.61, 0.05};
constexpr PairLook kNear{0.73, 0.03, 0.43, 0.74, 0.41};
constexpr PairLook kFar{0.87, 0.07, 0.53, 0.92, 0.78};
/** Two of the most alike places 3 m and more apart in a corridor of equal doors. */
constexpr PairLook kAlike{0.50, 0.02, 0.45, 0.76, 0.30};

TEST(SamePlace, isSurerTheMoreAlikeTwoViewsAre)
{
  EXPECT_GT(samePlaceProbability(kThere), samePlaceProbability(kNear));
  EXPECT_GT(samePlaceProbability(kNear), samePlaceProbability(kFar));
  EXPECT_GT(samePlaceProbability(kThere), 0.999);
  EXPECT_GT(samePlaceProbability(kNear), 0.5);
  EXPECT_LT(samePlaceProbability(kFar), 0.1);
}

TEST(SamePlace, everyNumberCounts)
{
  const double least = samePlaceProbability(kNear);
  for (double PairLook::*number : {&PairLook::alignedEdges, &PairLook::matchDistance,
                                   &PairLook::contrast, &PairLook::distanceProxy}) {
    PairLook worse = kNear;
    worse.*number *= 1.2;
    EXPECT_LT(samePlaceProbability(worse), least);
  }
}

TEST(SamePlace, oddsAndProbabilitySayTheSame)
{
  const double odds = otherPlaceOdds(kNear);
  EXPECT_NEAR(samePlaceProbability(kNear), 1.0 / (1.0 + odds), 1e-12);
}

TEST(SamePlace, standingThereIsToldFromWhatLooksAlike)
{
  EXPECT_GT(standingThereProbability(kThere), 0.999);
  EXPECT_LT(standingThereProbability(kAlike), 0.5);
  EXPECT_LT(standingThereProbability(kFar), 1e-3);
}

TEST(SamePlace, inAnotherLightLessIsAskedOfStandingThere)
{
  PairLook look = kThere;
  look.alignedEdges = 0.35;
  EXPECT_LT(standingThereProbability(look), 0.99);
  look.jeffrey = 0.5;
  EXPECT_GT(standingThereProbability(look), 0.99);
}

TEST(SamePlace, theSamePictureIsAProbabilityToo)
{
  EXPECT_NEAR(samePlaceProbability({0.0, 0.0, 0.0, 0.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(standingThereProbability({0.0, 0.0, 0.0, 0.0, 0.0}), 1.0, 1e-12);
}

} // namespace
} // namespace homeward
