// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/dataset/data_set.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/free_space.h>
#include <homeward/sim/light_preset.h>
#include <homeward/sim/mirror_renderer.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace homeward
{

/**
 * Places on a square grid over the reachable floor, in random headings, row by row.
 * @param spacing metres, > 0
 * @param seed of the grid's offset and the headings
 */
std::vector<Pose2> gridPoses(const FreeSpace &space, double spacing, std::uint64_t seed);

/**
 * Random places of the reachable floor in random headings. Of two counts with one seed, the larger
 * begins with the smaller.
 */
std::vector<Pose2> randomPoses(const FreeSpace &space, std::size_t count, std::uint64_t seed);

/** What takes the pictures of a data set in a simulated world. */
struct ViewSource
{
  std::shared_ptr<const Scene> scene;                    ///< the world
  Eigen::Isometry3d rMp = Eigen::Isometry3d::Identity(); ///< the mirror's focus on the robot
  MirrorCamera camera;                                   ///< nominal, as the data set has it
  std::uint64_t seed = 1;                                ///< of optics and noise
  std::uint32_t noiseStream = 0; ///< pictures of other streams have other noise
  bool exactOptics = false;      ///< the mirror is as its file says
  bool colour = false;           ///< pictures are BGR instead of gray
  RenderOptions rendering = {};  ///< of the mirror's picture
};

/** Told how many of how many pictures are taken. */
using Progress = std::function<void(std::size_t done, std::size_t all)>;

/**
 * Adds a mirror picture for each pose, in order, to a data set of the same camera. Files are named
 * `<light>_<number>.png`, numbered by the set's size. The same for any number of threads.
 */
void addRenderedViews(DataSet &set, const ViewSource &source, const std::vector<Pose2> &poses,
                      LightPreset light, const Progress &progress = {});

} // namespace homeward
