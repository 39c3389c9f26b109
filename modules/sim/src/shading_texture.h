// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

namespace homeward
{

/**
 * Linear RGB of a texture at (u, v), which repeats, v growing upwards.
 * @param footprint width of the ray at the surface, texels of level 0; picks the level
 */
Eigen::Vector3f sampleTexture(const Texture &texture, const Eigen::Vector2f &uv, float footprint);

} // namespace homeward
