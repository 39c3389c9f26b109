// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/calib/mirror_circles.h>

#include <string>

namespace homeward
{

/** What the views so far lack. */
struct Guidance
{
  std::string sentence; ///< what to do next
  bool enough = false;  ///< the views will do
};

/**
 * What to do with the board next, from the views taken so far: all round the mirror, out to the
 * rim and in, near and far, tilted.
 */
Guidance guide(const BoardViews &views, const MirrorCircles &mirror);

} // namespace homeward
