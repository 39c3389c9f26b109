// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/servo/visp_types.h>

namespace homeward
{

/** The selected rows of a matrix, in order. */
vpMatrix selectRows(const vpMatrix &rows, unsigned int select);

/**
 * s - wanted, every row, for features with more rows than ViSP has flags.
 * @throw LogicError when `wanted` has another number of rows
 */
vpColVector difference(const vpColVector &s, const vpBasicFeature &wanted);

/** An arrow from the middle of a picture at `angle`, rad counter-clockwise from up. */
template <class Pixel>
void displayArrow(const vpImage<Pixel> &I, double angle, const vpColor &color,
                  unsigned int thickness);

} // namespace homeward
