// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/sim/collision_map.h>

#include <opencv2/core/mat.hpp>

namespace homeward
{

/**
 * Where on the floor a robot fits.
 *
 * A cell of 5 cm is free when the whole body, its middle on the cell's, touches nothing in at least
 * one of 16 headings. It reaches as far as CollisionMap::bounds(), so that an endless ground plane
 * round a house is no room. Free cells that touch at a side or a corner form a region.
 */
class FloorGrid
{
public:
  /** The floor where the body of `map` can stand. */
  explicit FloorGrid(const CollisionMap &map);

  /** How its cells lie in the world. */
  const FloorRaster &raster() const { return m_raster; }

  /** Whether the cell of a point is free. Metres, world frame. */
  bool free(const Eigen::Vector2d &point) const;

  /** Whether a cell is free; false outside the raster. */
  bool freeCell(const cv::Point &cell) const
  {
    return m_raster.contains(cell) && m_free.at<unsigned char>(cell) != 0;
  }

  /** CV_8UC1, row = cell.y: 255 where free. */
  const cv::Mat &freeCells() const { return m_free; }

  /** CV_32SC1: 0 where not free, else the number of the cell's region. */
  const cv::Mat &regions() const { return m_regions; }

  /** The free cell nearest to a point within `reach` metres; {-1, -1} without one. */
  cv::Point nearestFree(const Eigen::Vector2d &point, double reach) const;

private:
  FloorRaster m_raster;
  cv::Mat m_free;
  cv::Mat m_regions;
};

/**
 * A good place to start in a world, the same every time, heading 0: in the largest region that does
 * not reach the edge of the world (or, when none of 4 m^2 is so enclosed, in the largest of all),
 * where nothing stands within 0.5 m of where the robot just fits, nearest to the world's origin.
 * Where no place is so wide, the widest.
 * @throw ConfigError when the robot fits nowhere
 */
Pose2 defaultStart(const CollisionMap &map, const FloorGrid &grid);

/** As above, for a world. */
Pose2 defaultStart(const Scene &scene, const RobotDescription &robot);

} // namespace homeward
