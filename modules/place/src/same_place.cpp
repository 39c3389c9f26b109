// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/same_place.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

constexpr double kLeast = 1e-4; // of a number of the same picture

double logOf(double value, double least = kLeast)
{
  return std::log(std::max(least, value));
}

} // namespace

double otherPlaceOdds(const PairLook &look)
{
  constexpr double kLeastProxy = 0.1; // nearer ones tell no more
  return std::exp(9.755 + 4.057 * logOf(look.alignedEdges) + 5.509 * logOf(look.matchDistance) +
                  4.588 * logOf(look.contrast) + 3.260 * logOf(look.distanceProxy, kLeastProxy));
}

double samePlaceProbability(const PairLook &look)
{
  return 1.0 / (1.0 + otherPlaceOdds(look));
}

double standingThereProbability(const PairLook &look)
{
  constexpr double kLeastProxy = 0.05;
  const double edges = logOf(look.alignedEdges);
  const double light = std::log(look.jeffrey + 1e-3);
  const double logOdds = -10.86 - 10.97 * edges - 4.12 * logOf(look.distanceProxy, kLeastProxy) +
                         8.10 * light + 5.94 * edges * light;
  return 1.0 / (1.0 + std::exp(-logOdds));
}

} // namespace homeward
