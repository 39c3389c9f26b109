// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace homeward
{

/** What a search for one place answered, against the truth. */
struct PlaceAnswer
{
  std::vector<bool> right; ///< by candidate, best first: is it the place?
  double unlikeness = 0.0; ///< of the first candidate; the smaller, the surer
  bool known = false;      ///< the place is among those searched
  double distance = 0.0;   ///< of the first candidate from the place, metres
};

/** How well places are recognised. Shares are of the queries whose place is known. */
struct PlaceScore
{
  std::size_t queries = 0; ///< whose place is known
  double recallAt1 = 0.0;  ///< share with a right one first
  double recallAt5 = 0.0;  ///< share with a right one among the first five
  double recallAt20 = 0.0; ///< share of queries whose place is among the best 20
  /** Share found by the largest threshold on unlikeness that accepts no wrong first candidate. */
  double recallAtFullPrecision = 0.0;
  /** Area under precision over recall, as the threshold on the first candidate grows. */
  double aucPr = 0.0;
  /** Shares of the first candidates up to each of kConfusionDistances away, and farther. */
  std::vector<double> confusion;
};

/** Metres. */
inline constexpr std::array kConfusionDistances{0.5, 1.0, 2.0, 4.0, 8.0};

/** Queries whose place is not known count where a threshold accepts them, as wrong. */
PlaceScore scorePlaces(const std::vector<PlaceAnswer> &answers);

} // namespace homeward
