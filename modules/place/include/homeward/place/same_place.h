// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace homeward
{

/** How a pair of panoramas compares, in ways that err apart. */
struct PairLook
{
  double alignedEdges = 1.0;  ///< dissimilarity() of AlignedEdges
  double jeffrey = 1.0;       ///< likewise, per pixel; large where the light has changed
  double matchDistance = 1.0; ///< of min-warping, see WarpingMatch, as are the others
  double contrast = 1.0;      ///< of min-warping
  double distanceProxy = 1.0; ///< of min-warping
};

/** A match given this is one to act on: nine in ten such are right, or more. */
inline constexpr double kSureProbability = 0.9;

/**
 * The odds that two views were not taken within a metre of each other: a product of powers of the
 * four numbers but jeffrey, fitted in the three worlds of data/worlds, by day and from day to night
 * and to two lamps, to the best of 20 candidates, whether the place was among them or not.
 */
double otherPlaceOdds(const PairLook &look);

/** Probability that two views were taken within a metre of each other. */
double samePlaceProbability(const PairLook &look);

/**
 * Probability that a view was taken where the other was, to 12 cm, and not at a place that looks
 * alike: there even a corridor of equal doors differs. By alignedEdges, jeffrey and distanceProxy;
 * in unchanged light much is asked of the first, else less. Fitted as otherPlaceOdds(), to views up
 * to 12 cm and farther than 0.8 m apart; what is between may get any.
 */
double standingThereProbability(const PairLook &look);

} // namespace homeward
