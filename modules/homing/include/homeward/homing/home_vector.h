// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace homeward
{

/** Where a stored place lies, as far as two panoramas can tell. */
struct HomeVector
{
  double direction = 0.0;     ///< bearing of home in frame p of the current view, rad, in [-pi, pi)
  double distanceProxy = 0.0; ///< > 0, dimensionless: about distance / typical landmark distance
  double headingChange = 0.0; ///< heading(current) - heading(stored), rad, in [-pi, pi)
  double confidence = 0.0;    ///< 0 (could be anything) to 1
};

} // namespace homeward
