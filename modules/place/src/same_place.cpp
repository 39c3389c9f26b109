// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/same_place.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

double samePlaceProbability(double alignedEdges, double matchDistance)
{
  constexpr double kOffset = -3.90;
  constexpr double kSlope = -5.29;
  constexpr double kLeast = 1e-6; // of the product: the same picture
  const double evidence =
      kOffset + kSlope * std::log(std::max(kLeast, alignedEdges * matchDistance));
  return 1.0 / (1.0 + std::exp(-evidence));
}

} // namespace homeward
