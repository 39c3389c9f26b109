// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/sim/free_space.h>

namespace homeward
{

/** The free space of a scene for the test robot, which starts at (1, 1) or elsewhere. */
inline FreeSpace spaceOf(Scene scene, const Eigen::Vector2d &start = {1.0, 1.0})
{
  const auto caster =
      std::make_shared<const RayCaster>(share(std::move(scene)), RayCaster::Layer::Collision);
  const auto map = std::make_shared<const CollisionMap>(*caster, testRobot());
  return {map, FloorGrid(*map), caster, 0.9, start};
}

// Two rooms of 4 m x 4 m, a wall at x = 4 with a door of 1 m at its upper end.
//
//   +------  ------+
//   |              |
//   |       |      |
//   |       |      |
//   +-------+------+
inline FreeSpace twoRooms(float doorWidth = 1.0F)
{
  Scene scene = makeRoom(8.1F, 4.0F);
  addBox(scene, {4.0F, 0.0F, 0.0F}, {4.1F, 4.0F - doorWidth, 2.5F});
  return spaceOf(std::move(scene));
}

} // namespace homeward
