// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/unified_camera.h>

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace homeward
{

/** A place on the board and where the picture shows it. */
struct BoardPixel
{
  Eigen::Vector2d board; ///< metres
  Eigen::Vector2d pixel;
};

/**
 * From the board to the picture near some points of it: a homography to the plane that touches the
 * unit sphere there, then a camera. A rough one will do to find a point; what it bends wrongly
 * moves the refined point by a hundredth of a pixel, which refineBoards() takes back.
 */
class BoardMap
{
public:
  /** @return nothing where fewer than four points, or points in one line, allow none */
  static std::optional<BoardMap> fit(const UnifiedCamera &camera,
                                     const std::vector<BoardPixel> &points);

  Eigen::Vector2d toPicture(const Eigen::Vector2d &board) const;

private:
  BoardMap(const UnifiedCamera &camera, const Eigen::Matrix3d &cHb) : m_camera(camera), m_cHb(cHb)
  {}

  UnifiedCamera m_camera;
  Eigen::Matrix3d m_cHb; ///< board, homogeneous, to a ray in frame c
};

} // namespace homeward
