// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/place/histogram.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace homeward
{

/** Turns that a correlation is computed for, in steps of a kTurns-th of a whole one. */
inline constexpr std::size_t kTurns = 128;

/** Elements of a row of the panorama in a spectrum: real parts, then imaginary ones. */
inline constexpr std::size_t kTurnRow = 2 * kTurnFrequencies;

/** The largest of the correlations by turn, between the turns, too. */
template <class Real> Real peakOf(const std::array<Real, kTurns> &byTurn)
{
  const auto best =
      static_cast<std::size_t>(std::max_element(byTurn.begin(), byTurn.end()) - byTurn.begin());
  const Real before = byTurn[(best + kTurns - 1) % kTurns];
  const Real after = byTurn[(best + 1) % kTurns];
  const Real bend = 2 * byTurn[best] - before - after;
  return bend > 0 ? byTurn[best] + (after - before) * (after - before) / (8 * bend) : byTurn[best];
}

/** Cosines and sines of the frequencies for turns up to a half. */
struct TurnWaves
{
  static constexpr std::size_t kHalf = kTurns / 2 + 1;
  static constexpr std::size_t kPadded = 80; ///< a multiple of all vector lengths

  /** By frequency and turn; 0 where padded. */
  alignas(64) std::array<std::array<float, kPadded>, kTurnFrequencies> cosines;
  alignas(64) std::array<std::array<float, kPadded>, kTurnFrequencies> sines;
};

const TurnWaves &turnWaves();

/** Correlations by turn of whole rows of spectra, in double precision. */
std::array<double, kTurns> correlationsByTurn(std::span<const float> a, std::span<const float> b);

} // namespace homeward
