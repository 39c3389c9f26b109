// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/sim/free_space.h>
#include <homeward/sim/scene.h>

#include <cstdint>
#include <vector>

namespace homeward
{

/** What has changed in a building since it was seen. */
struct SceneChange
{
  std::size_t people = 0; ///< boxes of a person's size, standing about
  double moveFurniture =
      0.0; ///< metres that models of a chair's size are moved, any way; they turn
};

/** What a change found to change. */
struct ChangedScene
{
  Scene scene;                            ///< as it is then
  std::size_t people = 0;                 ///< that stand in it
  std::vector<Eigen::AlignedBox3f> moved; ///< round each model that moved, where it is now
};

/**
 * The scene after a change. Models up to 1.1 m wide and 0.3 to 1.4 m high that stand on the floor
 * count as chairs; they go where their box meets nothing else, or stay.
 * @param space where people can stand
 * @param views where pictures will be taken: nothing comes nearer to them than 0.6 m
 */
ChangedScene changeScene(const Scene &scene, const FreeSpace &space,
                         const std::vector<Pose2> &views, const SceneChange &change,
                         std::uint64_t seed);

} // namespace homeward
