// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/target.h>
#include <homeward/camera/camera_file.h>
#include <homeward/evaluation/rendered_views.h>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace homeward
{

/** Where boards are held before a mirror. */
struct HeldBoards
{
  int count = 16;              ///< of pictures
  double nearest = 0.32;       ///< metres from the mirror to a board's middle
  double farthest = 0.6;       ///< metres
  double highest = 0.07;       ///< elevation of a board's middle, radians
  double tilt = radians(35.0); ///< about the board's x and y, at most, radians
  double turn = radians(40.0); ///< in the board's plane, at most, radians
  std::uint64_t seed = 1;      ///< of the poses
};

/**
 * Poses pMo of a target all round the mirror, facing it more or less: three heights in turn, from
 * the highest to 40 degrees below.
 * @throw ConfigError as checkTarget()
 */
std::vector<Eigen::Isometry3d> heldBoardPoses(const Target &target, const HeldBoards &held);

/** A mirror camera in a simulated room. */
struct BoardStudio
{
  std::shared_ptr<const Scene> room;                     ///< around the board
  Eigen::Isometry3d wMp = Eigen::Isometry3d::Identity(); ///< where the mirror stands in the room
  MirrorCamera camera;                                   ///< exactly; its lens bends nothing
  LightPreset light = LightPreset::Day;                  ///< that the room is in
  RenderOptions rendering = {};                          ///< of the mirror's picture
  std::uint64_t seed = 1;                                ///< of the noise
};

/**
 * One picture for each pose pMo of a printed target, CV_8UC1, in order. The room's light falls
 * on the boards as on all else. The same for any number of threads.
 * @throw ConfigError as checkTarget()
 */
std::vector<cv::Mat> renderBoards(const BoardStudio &studio, const Target &target,
                                  const std::vector<Eigen::Isometry3d> &poses,
                                  const Progress &progress = {});

} // namespace homeward
