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

  /** The cell of a point; it may lie outside the raster, and does for a point that is no number. */
  cv::Point cell(const Eigen::Vector2d &point) const
  {
    const Eigen::Vector2d scaled = (point - origin) / resolution;
    return {index(scaled.x()), index(scaled.y())};
  }

  /** The middle of a cell, metres. */
  Eigen::Vector2d centre(const cv::Point &cell) const
  {
    return origin + resolution * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
  }

  /** Whether it has such a cell. */
  bool contains(const cv::Point &cell) const
  {
    return cell.x >= 0 && cell.y >= 0 && cell.x < columns && cell.y < rows;
  }

private:
  /** Rounded down; far ones end where sums of a few still fit into an int, no number does low. */
  static int index(double scaled)
  {
    constexpr double kFar = 1e8;
    return static_cast<int>(std::floor(std::fmin(std::fmax(scaled, -kFar), kFar)));
  }
};

} // namespace homeward
