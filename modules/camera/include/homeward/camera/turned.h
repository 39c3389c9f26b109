// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

namespace homeward
{

/**
 * The panorama as it would be from the same place, turned: what is at azimuth a is then at
 * a - turn. Between columns it is interpolated (bicubic).
 * @param turn radians, counter-clockwise
 */
Panorama turned(const Panorama &panorama, double turn);

} // namespace homeward
