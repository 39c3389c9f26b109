// SPDX-License-Identifier: GPL-3.0-or-later
#include "feature_support.h"

#include <homeward/core/error.h>

#include <visp3/core/vpDisplay.h>
#include <visp3/core/vpImagePoint.h>

#include <algorithm>
#include <cmath>
#include <string>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace homeward
{

vpMatrix selectRows(const vpMatrix &rows, unsigned int select)
{
  vpMatrix selected;
  for (unsigned int row = 0; row < rows.getRows(); ++row) {
    if ((select & vpBasicFeature::FEATURE_LINE[row]) != 0U) {
      selected.stack(rows.getRow(row));
    }
  }
  return selected;
}

vpColVector difference(const vpColVector &s, const vpBasicFeature &wanted)
{
  constexpr unsigned int kEveryRow = ~0U; // FEATURE_ALL is 16 rows only
  if (wanted.getDimension(kEveryRow) != s.getRows()) {
    throw LogicError("wanted feature has " + std::to_string(wanted.getDimension(kEveryRow)) +
                     " rows, the current one has " + std::to_string(s.getRows()));
  }
  vpColVector e(s.getRows());
  for (unsigned int row = 0; row < s.getRows(); ++row) {
    e[row] = s[row] - wanted[row];
  }
  return e;
}

template <class Pixel>
void displayArrow(const vpImage<Pixel> &I, double angle, const vpColor &color,
                  unsigned int thickness)
{
  const vpImagePoint middle(I.getHeight() / 2.0, I.getWidth() / 2.0);
  const double length = std::min(I.getHeight(), I.getWidth()) / 4.0;
  const vpImagePoint tip(middle.get_i() - length * std::cos(angle),
                         middle.get_j() - length * std::sin(angle));
  vpDisplay::displayArrow(I, middle, tip, color, 4 + 2 * thickness, 2 + 2 * thickness, thickness);
}

template void displayArrow(const vpImage<unsigned char> &, double, const vpColor &, unsigned int);
template void displayArrow(const vpImage<vpRGBa> &, double, const vpColor &, unsigned int);

} // namespace homeward
