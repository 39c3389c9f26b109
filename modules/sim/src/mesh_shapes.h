// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

namespace homeward
{

/** A box centred at the origin; `size` full lengths, metres. Each face has the whole texture. */
Mesh makeBox(const Eigen::Vector3f &size);

/** A closed cylinder centred at the origin, along z. Metres. */
Mesh makeCylinder(float radius, float length);

/** An ellipsoid centred at the origin; half axes in metres. */
Mesh makeEllipsoid(const Eigen::Vector3f &radii);

/** A cylinder of `length` along z with half spheres on both ends, centred at the origin. Metres. */
Mesh makeCapsule(float radius, float length);

/** A rectangle through the origin with the normal given; `size` along its x and y. Metres. */
Mesh makePlane(const Eigen::Vector3f &normal, const Eigen::Vector2f &size);

} // namespace homeward
