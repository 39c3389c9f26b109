// SPDX-License-Identifier: GPL-3.0-or-later
#include "../../modules/homing/src/column_distances.h"
#include "../../modules/homing/src/column_minimum.h"

#include <homeward/core/random.h>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace homeward
{
namespace
{

std::vector<std::uint8_t> noise(Random &random, std::size_t size)
{
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t &byte : bytes) {
    byte = static_cast<std::uint8_t>(random.bits());
  }
  return bytes;
}

/** Runs a check with the instructions of each kind of processor that this one can stand for. */
template <class Check> void onEveryTarget(const Check &check)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    check();
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(VectorKernels, minimaAreThoseOfAPlainLoop)
{
  Random random(1, 1);
  for (const std::size_t size : {1U, 16U, 72U, 96U, 144U, 200U, 288U, 360U}) {
    std::vector<std::vector<std::uint8_t>> rows;
    std::vector<const std::uint8_t *> pointers;
    for (int r = 0; r < 7; ++r) {
      rows.push_back(noise(random, size + kVectorPadding));
    }
    for (const auto &row : rows) {
      pointers.push_back(row.data());
    }
    onEveryTarget([&] {
      std::vector<std::uint8_t> minima(size + kVectorPadding);
      std::vector<std::uint16_t> sums(size + kVectorPadding, 1000);
      addColumnMinima(pointers.data(), pointers.size(), size, minima.data(), sums.data());
      for (std::size_t i = 0; i < size; ++i) {
        std::uint8_t least = 255;
        for (const auto &row : rows) {
          least = std::min(least, row[i]);
        }
        ASSERT_EQ(minima[i], least) << i << " of " << size;
        ASSERT_EQ(sums[i], 1000 + least) << i << " of " << size;
      }
    });
  }
}

TEST(VectorKernels, distancesAreThoseOfAPlainLoop)
{
  Random random(2, 1);
  constexpr std::size_t kRows = 80;
  for (const std::size_t size : {1U, 8U, 72U, 144U, 288U}) {
    const std::vector<std::uint8_t> first = noise(random, kRows * size + kVectorPadding);
    const std::vector<std::uint8_t> second = noise(random, kRows * 2 * size + kVectorPadding);
    const DistanceScale scale{2500, 240};
    const std::size_t shift = size / 3;
    int saturated = 0;
    onEveryTarget([&] {
      std::vector<std::uint8_t> distances(size + kVectorPadding);
      columnDistances(first.data(), size, second.data() + shift, 2 * size, kRows, size, scale,
                      distances.data());
      for (std::size_t i = 0; i < size; ++i) {
        int sum = 0;
        for (std::size_t r = 0; r < kRows; ++r) {
          sum += std::abs(first[r * size + i] - second[r * 2 * size + shift + i]);
        }
        ASSERT_EQ(distances[i], std::min(240, sum * 2500 >> 16)) << i << " of " << size;
        saturated += sum * 2500 >> 16 > 240 ? 1 : 0;
      }
    });
    EXPECT_TRUE(size < 72 || saturated > 0) << "the largest value is tried too";
  }
}

} // namespace
} // namespace homeward
