// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/same_place.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

TEST(SamePlace, isSurerTheMoreAlikeTwoViewsAre)
{
  double last = 1.0;
  for (const double product : {0.0, 1e-3, 0.05, 0.2, 0.3, 0.5, 0.8, 2.0}) {
    const double probability = samePlaceProbability(product, 1.0);
    EXPECT_LE(probability, last);
    EXPECT_GE(probability, 0.0);
    last = probability;
  }
  EXPECT_GT(samePlaceProbability(0.0, 0.0), 0.999);
  EXPECT_LT(samePlaceProbability(1.0, 0.6), kSureProbability);
  EXPECT_DOUBLE_EQ(samePlaceProbability(0.5, 0.4), samePlaceProbability(0.4, 0.5));
}

} // namespace
} // namespace homeward
