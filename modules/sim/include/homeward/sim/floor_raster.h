// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

#include <cmath>

namespace homeward
{

/** A raster of square cells on the floor; cell (0, 0) has its lower left corner at the origin. */
struct FloorRaster
{
  Eigen::Vector2d origin{0.0, 0.0}; ///< metres, world frame
  double resolution = 0.05;         ///< side of a cell, metres
  int columns = 0;                  ///< cells along x
  int rows = 0;                     ///< cells along y

  /** The cell of a point; it may lie outside the raster. */
  cv::Point cell(const Eigen::Vector2d &point) const
  {
    const Eigen::Vector2d scaled = (point - origin) / resolution;
    return {static_cast<int>(std::floor(scaled.x())), static_cast<int>(std::floor(scaled.y()))};
  }

  /** The middle of a cell, metres. */
  Eigen::Vector2d centre(const cv::Point &cell) const
  {
    return origin + resolution * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
  }

  bool contains(const cv::Point &cell) const
  {
    return cell.x >= 0 && cell.y >= 0 && cell.x < columns && cell.y < rows;
  }
};

} // namespace homeward
