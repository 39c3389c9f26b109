// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

#include <vector>

namespace homeward
{

/** A panorama as the map file keeps it: a JPEG of quality 90, colour or gray. */
using ViewBytes = std::vector<unsigned char>;

/**
 * A panorama's picture as bytes for the map. The same picture gives the same bytes. What the robot
 * remembers must come from decodeView() of them, never from the sharper original, so that a resumed
 * run equals an uninterrupted one.
 * @throw LogicError unless the picture is CV_8UC1 or CV_8UC3 of its geometry's size
 */
ViewBytes encodeView(const Panorama &panorama);

/**
 * The panorama that encodeView() wrote; gray stays gray.
 * @throw RuntimeError when the bytes are no picture or its size is not that of the geometry
 */
Panorama decodeView(const ViewBytes &bytes, const PanoramaGeometry &geometry);

} // namespace homeward
