// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace homeward
{

/** A match given this is one to act on: nine in ten such are right, or more. */
inline constexpr double kSureProbability = 0.9;

/**
 * Probability that the known view most like a query shows its place, to a metre: a logistic of the
 * logarithm of the product of two looks that err apart. Fitted to the best of 20 candidates of 720
 * queries by day, twilight, night and two lamps in the three worlds of data/worlds.
 * @param alignedEdges dissimilarity() of AlignedEdges
 * @param matchDistance least match distance of min-warping (WarpingMatch::matchDistance)
 */
double samePlaceProbability(double alignedEdges, double matchDistance);

} // namespace homeward
