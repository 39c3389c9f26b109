// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/ray_caster.h>

#include <algorithm>
#include <memory>

namespace homeward
{

/** What laser and sonar meet: a building, and things in it that come and go. */
struct SolidWorld
{
  std::shared_ptr<const RayCaster> building;         ///< over its Layer::Collision
  std::shared_ptr<const RayCaster> things = nullptr; ///< likewise; null when there are none

  /** Distance to the first surface of either, as RayCaster::range(). */
  float range(const Eigen::Vector3f &origin, const Eigen::Vector3f &direction, float maxRange) const
  {
    const float wall = building->range(origin, direction, maxRange);
    return things ? std::min(wall, things->range(origin, direction, maxRange)) : wall;
  }
};

} // namespace homeward
