// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/random.h>

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace homeward
{
namespace
{

std::vector<std::uint64_t> draws(Random random, int count = 64)
{
  std::vector<std::uint64_t> result;
  for (int i = 0; i < count; ++i) {
    result.push_back(random.bits());
  }
  return result;
}

TEST(Random, SameSeedAndStreamGiveTheSameNumbers)
{
  EXPECT_EQ(draws(Random(7, 3)), draws(Random(7, 3)));
}

TEST(Random, SeedHighBitsAndStreamAllMatter)
{
  std::set<std::vector<std::uint64_t>> different;
  for (const std::uint64_t seed : {0ULL, 1ULL, 1ULL << 32U, (1ULL << 32U) + 1ULL}) {
    for (const std::uint32_t stream : {0U, 1U, 0x80000000U}) {
      different.insert(draws(Random(seed, stream)));
    }
  }
  EXPECT_EQ(different.size(), 12U);
}

TEST(Random, OneStreamDoesNotMoveAnother)
{
  Random a(5, 0);
  Random b(5, 1);
  const std::uint64_t alone = Random(5, 1).bits();
  a.bits();
  EXPECT_EQ(b.bits(), alone);
}

TEST(Random, NormalDrawsAreIndependentOfEachOthersSigma)
{
  Random a(5, 0);
  Random b(5, 0);
  a.normal(1.0);
  b.normal(100.0);
  EXPECT_EQ(a.normal(2.0), b.normal(2.0));
}

TEST(Random, UniformStaysInsideAndFills)
{
  Random random(11, 0);
  double sum = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.uniform(-2.0, 4.0);
    ASSERT_GE(x, -2.0);
    ASSERT_LT(x, 4.0);
    sum += x;
  }
  EXPECT_NEAR(sum / kCount, 1.0, 0.05); // 4 standard errors
}

TEST(Random, NormalHasItsMeanAndDeviation)
{
  Random random(12, 0);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal(3.0);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.09);
  EXPECT_NEAR(std::sqrt(squares / kCount), 3.0, 0.06);
}

} // namespace
} // namespace homeward
