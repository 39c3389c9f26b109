// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "canvas.h"

namespace homeward
{

inline constexpr Colour kChartInk{40, 40, 40};
inline constexpr Colour kChartRule{200, 200, 200};

/** Of one series among others; after twelve they come again. */
Colour seriesColour(std::size_t series);

/** Rules at every fifth from 0 to 100 %, from `left` to `right`, and what they mean; pixels. */
void drawShareScale(Canvas &canvas, double left, double right, double top, double height);

} // namespace homeward
