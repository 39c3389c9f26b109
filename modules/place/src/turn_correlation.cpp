// SPDX-License-Identifier: GPL-3.0-or-later
#include "turn_correlation.h"

#include <homeward/core/angle.h>

#include <cmath>

namespace homeward
{

const TurnWaves &turnWaves()
{
  static const TurnWaves kWaves = [] {
    TurnWaves waves{};
    for (std::size_t f = 0; f < kTurnFrequencies; ++f) {
      for (std::size_t turn = 0; turn < TurnWaves::kHalf; ++turn) {
        const double angle = 2.0 * kPi * static_cast<double>((f + 1) * turn % kTurns) / kTurns;
        waves.cosines[f][turn] = static_cast<float>(std::cos(angle));
        waves.sines[f][turn] = static_cast<float>(std::sin(angle));
      }
    }
    return waves;
  }();
  return kWaves;
}

std::array<double, kTurns> correlationsByTurn(std::span<const float> a, std::span<const float> b)
{
  std::array<double, kTurns> byTurn{};
  for (std::size_t f = 0; f < kTurnFrequencies; ++f) {
    double even = 0.0; // of the product of one spectrum with the other's conjugate
    double odd = 0.0;
    for (std::size_t row = 0; row + kTurnRow <= a.size(); row += kTurnRow) {
      const double realA = a[row + f];
      const double realB = b[row + f];
      const double imaginaryA = a[row + kTurnFrequencies + f];
      const double imaginaryB = b[row + kTurnFrequencies + f];
      even += realA * realB + imaginaryA * imaginaryB;
      odd += realA * imaginaryB - imaginaryA * realB;
    }
    for (std::size_t turn = 0; turn < kTurns; ++turn) {
      const double angle = 2.0 * kPi * static_cast<double>((f + 1) * turn % kTurns) / kTurns;
      byTurn[turn] += even * std::cos(angle) + odd * std::sin(angle);
    }
  }
  return byTurn;
}

} // namespace homeward
