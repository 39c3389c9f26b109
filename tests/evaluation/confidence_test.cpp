// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/evaluation/confidence.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

// Reference: R, prop.test(5, 10, correct = FALSE) and prop.test(0, 10, correct = FALSE).
TEST(Confidence, OfAShareIsWilsons)
{
  const Share half{5, 10};
  EXPECT_NEAR(half.value(), 0.5, 1e-12);
  EXPECT_NEAR(half.interval().low, 0.2365931, 1e-7);
  EXPECT_NEAR(half.interval().high, 0.7634069, 1e-7);
  EXPECT_NEAR((Share{0, 10}.interval().low), 0.0, 1e-12);
  EXPECT_NEAR((Share{0, 10}.interval().high), 0.2775328, 1e-7);
}

TEST(Confidence, OfAShareAndOfWhatIsLeftAreMirrored)
{
  for (std::size_t successes = 0; successes <= 20; ++successes) {
    const Interval share = Share{successes, 20}.interval();
    const Interval rest = Share{20 - successes, 20}.interval();
    EXPECT_NEAR(share.low, 1.0 - rest.high, 1e-12);
    EXPECT_GE(share.low, 0.0);
    EXPECT_LE(share.high, 1.0);
  }
}

TEST(Confidence, OfNothingIsEverything)
{
  const Interval interval = Share{}.interval();
  EXPECT_EQ(interval.low, 0.0);
  EXPECT_EQ(interval.high, 1.0);
  EXPECT_THROW((Share{3, 2}.interval()), LogicError);
}

// Reference: R, t.test(1:5).
TEST(Confidence, OfAMeanIsStudents)
{
  const Mean mean = meanOf({1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_EQ(mean.count, 5U);
  EXPECT_NEAR(mean.value, 3.0, 1e-12);
  ASSERT_TRUE(mean.interval);
  EXPECT_NEAR(mean.interval->low, 1.036757, 1e-6);
  EXPECT_NEAR(mean.interval->high, 4.963243, 1e-6);
}

TEST(Confidence, OneValueTellsNothingOfItsSpread)
{
  EXPECT_FALSE(meanOf({7.0}).interval);
  EXPECT_EQ(meanOf({7.0}).value, 7.0);
  EXPECT_EQ(meanOf({}).count, 0U);
  EXPECT_THROW(meanOf({1.0, std::numeric_limits<double>::quiet_NaN()}), LogicError);
}

TEST(Confidence, TheTruthLiesWithinNineteenTimesOfTwenty)
{
  constexpr int kTimes = 2000;
  constexpr double kTruth = 0.3;
  Random random(1, 1);
  int shares = 0;
  int means = 0;
  for (int i = 0; i < kTimes; ++i) {
    Share share{0, 20};
    std::vector<double> values;
    for (int j = 0; j < 20; ++j) {
      share.successes += random.uniform(0.0, 1.0) < kTruth ? 1 : 0;
      values.push_back(kTruth + random.normal(2.0));
    }
    const Interval of = share.interval();
    shares += of.low <= kTruth && kTruth <= of.high ? 1 : 0;
    const Interval mean = meanOf(values).interval.value();
    means += mean.low <= kTruth && kTruth <= mean.high ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(shares) / kTimes, 0.95, 0.03); // shares are whole numbers
  EXPECT_NEAR(static_cast<double>(means) / kTimes, 0.95, 0.015);
}

} // namespace
} // namespace homeward
