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

void minimaOfRows(const std::uint8_t *const *rows, std::size_t rowCount, std::size_t size,
                  std::uint8_t *minima)
{
  const hn::ScalableTag<std::uint8_t> bytes;
  const std::size_t lanes = hn::Lanes(bytes);
  std::size_t i = 0;
  // Four vectors at a time stay in registers while all rows stream by.
  for (; i + 3 * lanes < size; i += 4 * lanes) {
    auto a = hn::Set(bytes, std::uint8_t{255});
    auto b = a;
    auto c = a;
    auto d = a;
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
  for (; i < size; i += lanes) {
    auto a = hn::Set(bytes, std::uint8_t{255});
    for (std::size_t r = 0; r < rowCount; ++r) {
      a = hn::Min(a, hn::LoadU(bytes, rows[r] + i));
    }
    hn::StoreU(a, bytes, minima + i);
  }
}

} // namespace HWY_NAMESPACE
} // namespace homeward
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward
{

HWY_EXPORT(minimaOfRows);

void columnMinima(const std::uint8_t *const *rows, std::size_t rowCount, std::size_t size,
                  std::uint8_t *minima)
{
  HWY_DYNAMIC_DISPATCH(minimaOfRows)(rows, rowCount, size, minima);
}

} // namespace homeward
#endif
