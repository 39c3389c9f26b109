// SPDX-License-Identifier: GPL-3.0-or-later
#include "column_minimum.h"

#undef HWY_TARGET_INCLUDE
// Found from include/, which is on the search path.
#define HWY_TARGET_INCLUDE "../src/column_minimum.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward
{
namespace HWY_NAMESPACE // NOLINT(readability-identifier-naming): chosen by the target
{

namespace hn = hwy::HWY_NAMESPACE;

void addMinimaOfRows(const std::uint8_t *const *rows, std::size_t rowCount, std::size_t size,
                     std::uint8_t *minima, std::uint16_t *sums)
{
  const hn::ScalableTag<std::uint8_t> bytes;
  const std::size_t lanes = hn::Lanes(bytes);
  const auto most = hn::Set(bytes, std::uint8_t{255});
  std::size_t i = 0;
  // Several vectors at a time stay in registers while all rows stream by.
  for (; i + 3 * lanes < size; i += 4 * lanes) {
    auto a = most;
    auto b = most;
    auto c = most;
    auto d = most;
    for (std::size_t r = 0; r < rowCount; ++r) {
      const std::uint8_t *row = rows[r] + i;
      a = hn::Min(a, hn::LoadU(bytes, row));
      b = hn::Min(b, hn::LoadU(bytes, row + lanes));
      c = hn::Min(c, hn::LoadU(bytes, row + 2 * lanes));
      d = hn::Min(d, hn::LoadU(bytes, row + 3 * lanes));
    }
    hn::StoreU(a, bytes, minima + i);
    hn::StoreU(b, bytes, minima + i + lanes);
    hn::StoreU(c, bytes, minima + i + 2 * lanes);
    hn::StoreU(d, bytes, minima + i + 3 * lanes);
  }
  if (i + 2 * lanes < size) {
    auto a = most;
    auto b = most;
    auto c = most;
    for (std::size_t r = 0; r < rowCount; ++r) {
      const std::uint8_t *row = rows[r] + i;
      a = hn::Min(a, hn::LoadU(bytes, row));
      b = hn::Min(b, hn::LoadU(bytes, row + lanes));
      c = hn::Min(c, hn::LoadU(bytes, row + 2 * lanes));
    }
    hn::StoreU(a, bytes, minima + i);
    hn::StoreU(b, bytes, minima + i + lanes);
    hn::StoreU(c, bytes, minima + i + 2 * lanes);
    i += 3 * lanes;
  }
  for (; i + lanes < size; i += 2 * lanes) {
    auto a = most;
    auto b = most;
    for (std::size_t r = 0; r < rowCount; ++r) {
      a = hn::Min(a, hn::LoadU(bytes, rows[r] + i));
      b = hn::Min(b, hn::LoadU(bytes, rows[r] + i + lanes));
    }
    hn::StoreU(a, bytes, minima + i);
    hn::StoreU(b, bytes, minima + i + lanes);
  }
  for (; i < size; i += lanes) {
    auto a = most;
    for (std::size_t r = 0; r < rowCount; ++r) {
      a = hn::Min(a, hn::LoadU(bytes, rows[r] + i));
    }
    hn::StoreU(a, bytes, minima + i);
  }
  const hn::ScalableTag<std::uint16_t> words;
  const hn::Rebind<std::uint8_t, decltype(words)> halves;
  for (i = 0; i < size; i += hn::Lanes(words)) {
    const auto wide = hn::PromoteTo(words, hn::LoadU(halves, minima + i));
    hn::StoreU(hn::Add(hn::LoadU(words, sums + i), wide), words, sums + i);
  }
}

} // namespace HWY_NAMESPACE
} // namespace homeward
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward
{

HWY_EXPORT(addMinimaOfRows);

void addColumnMinima(const std::uint8_t *const *rows, std::size_t rowCount, std::size_t size,
                     std::uint8_t *minima, std::uint16_t *sums)
{
  HWY_DYNAMIC_DISPATCH(addMinimaOfRows)(rows, rowCount, size, minima, sums);
}

} // namespace homeward
#endif
