// SPDX-License-Identifier: GPL-3.0-or-later
#include "row_distance.h"

#include "signature_values.h"
#include "turn_correlation.h"

#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
// Found from include/, which is on the search path.
#define HWY_TARGET_INCLUDE "../src/row_distance.cpp"
#include <hwy/foreach_target.h>

#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward
{
namespace HWY_NAMESPACE // NOLINT(readability-identifier-naming): chosen by the target
{

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kRowAlignment / sizeof(float)>;
using Bytes = hn::CappedTag<std::uint8_t, kRowAlignment>;

/** Newton's steps that bring ApproximateReciprocal() to 6.2e-5 or better. */
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
constexpr int kReciprocalSteps = 0; // 14 bits
#elif HWY_ARCH_X86
constexpr int kReciprocalSteps = 1; // 12 bits
#else
constexpr int kReciprocalSteps = 2; // 7 bits or more
#endif

template <class V> V reciprocal(V x)
{
  const Floats tag;
  V y = hn::ApproximateReciprocal(x);
  for (int i = 0; i < kReciprocalSteps; ++i) {
    y = hn::Mul(y, hn::NegMulAdd(x, y, hn::Set(tag, 2.0F)));
  }
  return y;
}

/** Stands for zero in a divisor. */
constexpr float kTiny = 1e-10F;

// What each metric keeps of an element of the query, and what an element of a row adds to the sum.

struct JeffreyTerm
{
  // h(q) = kGain (1 + kC q) (1 + kD q) / ((1 + kE q) (1 + kF q) (1 + kG q)), fitted to the least
  // relative error on 0 <= q <= 1.
  template <class V> static V add(V rootA, V rootB, V b, V sum)
  {
    const Floats tag;
    const auto s = hn::MulAdd(rootA, rootA, b);
    const auto d = hn::MulSub(rootA, rootA, b);
    const auto m = hn::Mul(rootA, rootB); // q s / 2
    const auto above = hn::Mul(hn::MulAdd(m, hn::Set(tag, 2.0F * kC), s),
                               hn::MulAdd(m, hn::Set(tag, 2.0F * kD), s));
    const auto below = hn::Mul(hn::Mul(hn::MulAdd(m, hn::Set(tag, 2.0F * kE), s),
                                       hn::MulAdd(m, hn::Set(tag, 2.0F * kF), s)),
                               hn::MulAdd(m, hn::Set(tag, 2.0F * kG), s));
    return hn::MulAdd(hn::Mul(hn::Mul(d, d), above), reciprocal(below), sum);
  }
  template <class V> static V prepare(V rootB)
  {
    return hn::Max(hn::Mul(rootB, rootB), hn::Set(Floats(), kTiny));
  }

  static constexpr float kGain = 0.693151176F;
  static constexpr float kC = 20.0594482F;
  static constexpr float kD = 3.14190435F;
  static constexpr float kE = 0.578623354F;
  static constexpr float kF = 2.65130711F;
  static constexpr float kG = 19.9792957F;
};

struct ChiSquareTerm
{
  template <class V> static V add(V a, V /*b*/, V b, V sum)
  {
    const auto d = hn::Sub(a, b);
    return hn::MulAdd(hn::Mul(d, d), reciprocal(hn::Add(a, b)), sum);
  }
  template <class V> static V prepare(V b) { return hn::Max(b, hn::Set(Floats(), kTiny)); }
  static constexpr float kGain = 1.0F;
};

struct AbsoluteTerm
{
  template <class V> static V add(V a, V b, V /*prepared*/, V sum)
  {
    return hn::Add(sum, hn::AbsDiff(a, b));
  }
  template <class V> static V prepare(V b) { return b; }
  static constexpr float kGain = 1.0F;
};

struct SquaredTerm
{
  template <class V> static V add(V a, V b, V /*prepared*/, V sum)
  {
    const auto d = hn::Sub(a, b);
    return hn::MulAdd(d, d, sum);
  }
  template <class V> static V prepare(V b) { return b; }
  static constexpr float kGain = 1.0F;
};

/** One row, or four side by side that share the query's loads; a row's sum is the same in both. */
template <class Term, std::size_t kRows>
void sumRows(const float *query, const float *rows, std::size_t size, float *distances)
{
  const Floats tag;
  const float *r0 = rows;
  const float *r1 = rows + (kRows > 1 ? size : 0);
  const float *r2 = rows + (kRows > 2 ? 2 * size : 0);
  const float *r3 = rows + (kRows > 3 ? 3 * size : 0);
  auto s0 = hn::Zero(tag);
  auto s1 = s0;
  auto s2 = s0;
  auto s3 = s0;
  for (std::size_t i = 0; i < size; i += hn::Lanes(tag)) {
    const auto b = hn::Load(tag, query + i);
    const auto prepared = Term::prepare(b);
    s0 = Term::add(hn::Load(tag, r0 + i), b, prepared, s0);
    if constexpr (kRows > 1) {
      s1 = Term::add(hn::Load(tag, r1 + i), b, prepared, s1);
      s2 = Term::add(hn::Load(tag, r2 + i), b, prepared, s2);
      s3 = Term::add(hn::Load(tag, r3 + i), b, prepared, s3);
    }
  }
  distances[0] = Term::kGain * hn::GetLane(hn::SumOfLanes(tag, s0));
  if constexpr (kRows > 1) {
    distances[1] = Term::kGain * hn::GetLane(hn::SumOfLanes(tag, s1));
    distances[2] = Term::kGain * hn::GetLane(hn::SumOfLanes(tag, s2));
    distances[3] = Term::kGain * hn::GetLane(hn::SumOfLanes(tag, s3));
  }
}

template <class Term> void sumBlock(const std::byte *query, const RowBlock &block, float *distances)
{
  const auto *b = reinterpret_cast<const float *>(query);
  const auto *rows = reinterpret_cast<const float *>(block.rows);
  const std::size_t size = block.rowBytes / sizeof(float);
  std::size_t row = 0;
  for (; row + 4 <= block.count; row += 4) {
    sumRows<Term, 4>(b, rows + row * size, size, distances + row);
  }
  for (; row < block.count; ++row) {
    sumRows<Term, 1>(b, rows + row * size, size, distances + row);
  }
}

void sumBytes(const std::byte *query, const RowBlock &block, float *distances)
{
  const Bytes tag;
  const hn::Repartition<std::uint64_t, Bytes> words;
  const auto *b = reinterpret_cast<const std::uint8_t *>(query);
  const auto *row = reinterpret_cast<const std::uint8_t *>(block.rows);
  for (std::size_t r = 0; r < block.count; ++r, row += block.rowBytes) {
    auto sum = hn::Zero(words);
    for (std::size_t i = 0; i < block.rowBytes; i += hn::Lanes(tag)) {
      const auto x = hn::Load(tag, row + i);
      const auto y = hn::Load(tag, b + i);
      sum = hn::Add(sum, hn::SumsOf8(hn::Sub(hn::Max(x, y), hn::Min(x, y))));
    }
    distances[r] = static_cast<float>(hn::GetLane(hn::SumOfLanes(words, sum)));
  }
}

/** The product of one spectrum with the other's conjugate, summed over their rows. */
void crossSpectrum(const float *a, const float *b, std::size_t size, float *even, float *odd)
{
  const Floats tag;
  for (std::size_t f = 0; f < kTurnFrequencies; f += hn::Lanes(tag)) {
    auto e = hn::Zero(tag);
    auto o = e;
    for (std::size_t row = f; row < size; row += kTurnRow) {
      const auto realA = hn::Load(tag, a + row);
      const auto realB = hn::Load(tag, b + row);
      const auto imaginaryA = hn::Load(tag, a + row + kTurnFrequencies);
      const auto imaginaryB = hn::Load(tag, b + row + kTurnFrequencies);
      e = hn::MulAdd(realA, realB, hn::MulAdd(imaginaryA, imaginaryB, e));
      o = hn::MulAdd(realA, imaginaryB, hn::NegMulAdd(imaginaryA, realB, o));
    }
    hn::Store(e, tag, even + f);
    hn::Store(o, tag, odd + f);
  }
}

/** What turns to the left and turns to the right have in common, and by what they differ. */
void turned(const float *even, const float *odd, const TurnWaves &waves, float *same, float *other)
{
  const Floats tag;
  for (std::size_t turn = 0; turn < TurnWaves::kPadded; turn += hn::Lanes(tag)) {
    auto s = hn::Zero(tag);
    auto o = s;
    for (std::size_t f = 0; f < kTurnFrequencies; ++f) {
      s = hn::MulAdd(hn::Set(tag, even[f]), hn::Load(tag, waves.cosines[f].data() + turn), s);
      o = hn::MulAdd(hn::Set(tag, odd[f]), hn::Load(tag, waves.sines[f].data() + turn), o);
    }
    hn::Store(s, tag, same + turn);
    hn::Store(o, tag, other + turn);
  }
}

/** The largest correlation over all turns of spectra of `size` numbers. */
float peakCorrelation(const float *a, const float *b, std::size_t size, float unturned,
                      const TurnWaves &waves)
{
  alignas(kRowAlignment) std::array<float, kTurnFrequencies> even;
  alignas(kRowAlignment) std::array<float, kTurnFrequencies> odd;
  alignas(kRowAlignment) std::array<float, TurnWaves::kPadded> same;
  alignas(kRowAlignment) std::array<float, TurnWaves::kPadded> other;
  std::array<float, kTurns> byTurn;
  crossSpectrum(a, b, size, even.data(), odd.data());
  turned(even.data(), odd.data(), waves, same.data(), other.data());
  for (std::size_t turn = 0; turn < kTurns / 2; ++turn) {
    byTurn[turn] = same[turn] + other[turn];
    byTurn[kTurns - 1 - turn] = same[turn + 1] - other[turn + 1];
  }
  byTurn[0] += unturned;
  return peakOf(byTurn);
}

/** Bytes as numbers about zero. @return the sum of their squares */
float widen(const std::byte *bytes, std::size_t size, float *values)
{
  const Floats tag;
  const hn::Rebind<std::uint8_t, Floats> narrow;
  const hn::Rebind<std::int32_t, Floats> whole;
  const auto zero = hn::Set(tag, kZeroByte);
  auto squares = hn::Zero(tag);
  const auto *from = reinterpret_cast<const std::uint8_t *>(bytes);
  for (std::size_t i = 0; i < size; i += hn::Lanes(tag)) {
    const auto value =
        hn::Sub(hn::ConvertTo(tag, hn::PromoteTo(whole, hn::LoadU(narrow, from + i))), zero);
    hn::Store(value, tag, values + i);
    squares = hn::MulAdd(value, value, squares);
  }
  return hn::GetLane(hn::SumOfLanes(tag, squares));
}

void correlateBytes(const std::byte *query, const RowBlock &block, float *distances)
{
  const TurnWaves &waves = turnWaves();
  const std::size_t size = block.rowBytes;
  const auto room = [size] { return hwy::AllocateAligned<float>(size); };
  const auto a = room();
  const auto b = room();
  const float squareB = widen(query, size, b.get());
  for (std::size_t r = 0; r < block.count; ++r) {
    const float squareA = widen(block.rows + r * size, size, a.get());
    const float square = squareA * squareB;
    if (square > 0.0F) {
      const float peak = peakCorrelation(a.get(), b.get(), size, 0.0F, waves);
      distances[r] = std::max(0.0F, 1.0F - peak / std::sqrt(square));
    }
    else {
      distances[r] = squareA == squareB ? 0.0F : 1.0F;
    }
  }
}

void correlateBlock(const std::byte *query, const RowBlock &block, float *distances)
{
  const TurnWaves &waves = turnWaves();
  const auto *b = reinterpret_cast<const float *>(query);
  const auto *a = reinterpret_cast<const float *>(block.rows);
  const std::size_t size = block.rowBytes / sizeof(float);
  const std::size_t spectra = size / kTurnRow * kTurnRow;
  for (std::size_t r = 0; r < block.count; ++r, a += size) {
    const float unturned = spectra < size ? a[spectra] * b[spectra] : 0.0F;
    distances[r] = std::max(0.0F, 1.0F - peakCorrelation(a, b, spectra, unturned, waves));
  }
}

void dispatchedRowDistances(RowMetric metric, const std::byte *query, const RowBlock &block,
                            float *distances)
{
  switch (metric) {
  case RowMetric::Jeffrey:
    return sumBlock<JeffreyTerm>(query, block, distances);
  case RowMetric::ChiSquare:
    return sumBlock<ChiSquareTerm>(query, block, distances);
  case RowMetric::Absolute:
    return sumBlock<AbsoluteTerm>(query, block, distances);
  case RowMetric::SquaredDifference:
    return sumBlock<SquaredTerm>(query, block, distances);
  case RowMetric::TurnCorrelation:
    return correlateBlock(query, block, distances);
  case RowMetric::TurnCorrelationBytes:
    return correlateBytes(query, block, distances);
  case RowMetric::AbsoluteBytes:
    return sumBytes(query, block, distances);
  }
}

} // namespace HWY_NAMESPACE
} // namespace homeward
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward
{

HWY_EXPORT(dispatchedRowDistances);

void rowDistances(RowMetric metric, const std::byte *query, const RowBlock &block, float *distances)
{
  HWY_DYNAMIC_DISPATCH(dispatchedRowDistances)(metric, query, block, distances);
}

} // namespace homeward
#endif
