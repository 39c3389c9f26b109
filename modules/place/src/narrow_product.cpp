// SPDX-License-Identifier: GPL-3.0-or-later
#include "narrow_product.h"

#undef HWY_TARGET_INCLUDE
// Found from include/, which is on the search path.
#define HWY_TARGET_INCLUDE "../src/narrow_product.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward
{
namespace HWY_NAMESPACE // NOLINT(readability-identifier-naming): chosen by the target
{

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kNarrowColumns / 2>;

/** Two rows and two vectors of columns: four sums in registers while `inner` streams by. */
void multiplyTwoRows(const float *a0, const float *a1, std::size_t inner, const float *b,
                     float *product0, float *product1)
{
  const Floats tag;
  const std::size_t lanes = hn::Lanes(tag);
  for (std::size_t column = 0; column < kNarrowColumns; column += 2 * lanes) {
    auto s00 = hn::Zero(tag);
    auto s01 = s00;
    auto s10 = s00;
    auto s11 = s00;
    for (std::size_t n = 0; n < inner; ++n) {
      const float *row = b + n * kNarrowColumns + column;
      const auto left = hn::LoadU(tag, row);
      const auto right = hn::LoadU(tag, row + lanes);
      const auto x0 = hn::Set(tag, a0[n]);
      const auto x1 = hn::Set(tag, a1[n]);
      s00 = hn::MulAdd(x0, left, s00);
      s01 = hn::MulAdd(x0, right, s01);
      s10 = hn::MulAdd(x1, left, s10);
      s11 = hn::MulAdd(x1, right, s11);
    }
    hn::StoreU(s00, tag, product0 + column);
    hn::StoreU(s01, tag, product0 + column + lanes);
    hn::StoreU(s10, tag, product1 + column);
    hn::StoreU(s11, tag, product1 + column + lanes);
  }
}

void multiplyRows(const float *a, std::size_t rows, std::size_t inner, const float *b,
                  float *product)
{
  for (std::size_t row = 0; row < rows; row += 2) {
    const std::size_t other = row + 1 < rows ? row + 1 : row; // the last one twice, if odd
    multiplyTwoRows(a + row * inner, a + other * inner, inner, b, product + row * kNarrowColumns,
                    product + other * kNarrowColumns);
  }
}

} // namespace HWY_NAMESPACE
} // namespace homeward
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward
{

HWY_EXPORT(multiplyRows);

void narrowProduct(const float *a, std::size_t rows, std::size_t inner, const float *b,
                   float *product)
{
  HWY_DYNAMIC_DISPATCH(multiplyRows)(a, rows, inner, b, product);
}

} // namespace homeward
#endif
