// SPDX-License-Identifier: GPL-3.0-or-later
#include "column_distances.h"

#undef HWY_TARGET_INCLUDE
// Found from include/, which is on the search path.
#define HWY_TARGET_INCLUDE "../src/column_distances.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward
{
namespace HWY_NAMESPACE // NOLINT(readability-identifier-naming): chosen by the target
{

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void distancesOfColumns(const std::uint8_t *first, std::size_t firstStride,
                        const std::uint8_t *second, std::size_t secondStride, std::size_t rows,
                        std::size_t size, const DistanceScale &scale, std::uint8_t *distances)
{
  for (std::size_t i = 0; i < size; ++i) {
    unsigned sum = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      const int difference = first[r * firstStride + i] - second[r * secondStride + i];
      sum += static_cast<unsigned>(difference < 0 ? -difference : difference);
    }
    const unsigned scaled = (sum * scale.factor) >> 16U;
    distances[i] = static_cast<std::uint8_t>(scaled < scale.most ? scaled : scale.most);
  }
}

#else

void distancesOfColumns(const std::uint8_t *first, std::size_t firstStride,
                        const std::uint8_t *second, std::size_t secondStride, std::size_t rows,
                        std::size_t size, const DistanceScale &scale, std::uint8_t *distances)
{
  const hn::ScalableTag<std::uint8_t> bytes;
  const hn::Repartition<std::uint16_t, decltype(bytes)> words;
  const auto low = hn::Set(words, std::uint16_t{255});
  const auto factor = hn::Set(words, scale.factor);
  const auto most = hn::Set(words, scale.most);
  for (std::size_t i = 0; i < size; i += hn::Lanes(bytes)) {
    // Bytes of even and of odd place add up apart: no widening, no change of order.
    auto even = hn::Zero(words);
    auto odd = hn::Zero(words);
    for (std::size_t r = 0; r < rows; ++r) {
      const auto a = hn::LoadU(bytes, first + r * firstStride + i);
      const auto b = hn::LoadU(bytes, second + r * secondStride + i);
      const auto difference =
          hn::BitCast(words, hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)));
      even = hn::Add(even, hn::And(difference, low));
      odd = hn::Add(odd, hn::ShiftRight<8>(difference));
    }
    even = hn::Min(most, hn::MulHigh(even, factor));
    odd = hn::Min(most, hn::MulHigh(odd, factor));
    hn::StoreU(hn::BitCast(bytes, hn::Or(even, hn::ShiftLeft<8>(odd))), bytes, distances + i);
  }
}

#endif

} // namespace HWY_NAMESPACE
} // namespace homeward
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward
{

HWY_EXPORT(distancesOfColumns);

void columnDistances(const std::uint8_t *first, std::size_t firstStride, const std::uint8_t *second,
                     std::size_t secondStride, std::size_t rows, std::size_t size,
                     const DistanceScale &scale, std::uint8_t *distances)
{
  HWY_DYNAMIC_DISPATCH(distancesOfColumns)
  (first, firstStride, second, secondStride, rows, size, scale, distances);
}

} // namespace homeward
#endif
