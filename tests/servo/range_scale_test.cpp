// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/range_scale.h>

#include <homeward/core/random.h>

#include <gtest/gtest.h>

#include <cmath>

namespace homeward
{
namespace
{

/** Metres that a proxy truly stands for. */
class RangeScaleOf : public testing::TestWithParam<double>
{
protected:
  /** Scale found on a straight way that passes home, looking every 10 cm. */
  double driven(double aside, double from, double to, double bearingNoise, double proxyNoise) const
  {
    RangeScale scale(2.0);
    Random random(3, 1);
    for (double x = from; x <= to; x += 0.1) {
      const Eigen::Vector2d way = Eigen::Vector2d(0.0, aside) - Eigen::Vector2d(x, 0.0);
      const double proxy = way.norm() / GetParam() * (1.0 + random.normal(proxyNoise));
      scale.add({x, 0.0}, std::atan2(way.y(), way.x()) + random.normal(bearingNoise), proxy, 1.0);
    }
    return scale.metres();
  }
};

TEST_P(RangeScaleOf, isFoundWhereBearingsCross)
{
  EXPECT_NEAR(driven(0.4, -0.5, 0.3, 0.0, 0.0), GetParam(), 0.1 * GetParam());
}

TEST_P(RangeScaleOf, isFoundWithNoisyViews)
{
  EXPECT_NEAR(driven(0.4, -0.5, 0.3, 0.05, 0.1), GetParam(), 0.25 * GetParam());
}

TEST_P(RangeScaleOf, isFoundStraightAhead)
{
  EXPECT_NEAR(driven(0.0, -0.7, -0.1, 0.03, 0.05), GetParam(), 0.25 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scales, RangeScaleOf, testing::Values(1.2, 2.0, 3.5, 6.0));

TEST(RangeScale, staysAtTheGuessWhereNothingIsLearnt)
{
  RangeScale scale(2.0);
  EXPECT_EQ(scale.metres(), 2.0);
  for (int i = 0; i < 10; ++i) {
    scale.add({1.0, 2.0}, 0.7, 0.2, 1.0);
  }
  EXPECT_NEAR(scale.metres(), 2.0, 1e-9);
}

TEST(RangeScale, takesNoViewWithoutWeight)
{
  RangeScale scale(2.0);
  for (double x = -0.5; x < 0.3; x += 0.1) {
    const Eigen::Vector2d way(-x, 0.4);
    scale.add({x, 0.0}, std::atan2(way.y(), way.x()), way.norm() / 4.0, 0.0);
  }
  EXPECT_EQ(scale.metres(), 2.0);
}

} // namespace
} // namespace homeward
