// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/floor_grid.h>
#include <homeward/sim/ray_caster.h>

#include <memory>
#include <optional>
#include <vector>

namespace homeward
{

/** A gray picture of the floor, seen from above, x to the right and y up. */
struct FloorPlan
{
  /** CV_8UC1: 0 where something stands, 255 where the robot can get to, 190 elsewhere. */
  cv::Mat image;
  Eigen::Vector2d origin{0.0, 0.0}; ///< lower left corner of the picture, metres, world frame
  double resolution = 0.02;         ///< side of a pixel, metres

  /** Pixel (u, v), not rounded, of a point of the world. */
  Eigen::Vector2d pixel(const Eigen::Vector2d &point) const
  {
    const Eigen::Vector2d scaled = (point - origin) / resolution;
    return {scaled.x() - 0.5, image.rows - scaled.y() - 0.5};
  }
};

/** What can be reached and seen from a start: the truth that missions are measured by. */
class FreeSpace
{
public:
  /**
   * @param map of the world for the robot
   * @param grid over the same map
   * @param collisions over Layer::Collision of the same world; lines of sight end there
   * @param eyeHeight of lines of sight above the floor (the mirror's focus), metres
   * @param start where the flood fill begins, metres, world frame
   */
  FreeSpace(std::shared_ptr<const CollisionMap> map, FloorGrid grid,
            std::shared_ptr<const RayCaster> collisions, double eyeHeight,
            const Eigen::Vector2d &start);

  /** Whether the robot fits at a point (FloorGrid). Metres, world frame. */
  bool free(const Eigen::Vector2d &point) const { return m_grid.free(point); }

  /** Whether the robot fits there and can get there from the start. */
  bool reachable(const Eigen::Vector2d &point) const;

  /** The middles of all cells that can be reached. */
  const std::vector<Eigen::Vector2d> &reachableCells() const { return m_cells; }

  /** The same from elsewhere: the middles of the free cells of that point's region. */
  std::vector<Eigen::Vector2d> reachableCells(const Eigen::Vector2d &from) const;

  /** Of all cells that can be reached, square metres. */
  double area() const;

  /** Of the region of another point, square metres; 0 where the robot does not fit. */
  double areaAround(const Eigen::Vector2d &point) const;

  /** Whether nothing stands on the straight line at eye height between two points of the floor. */
  bool sees(const Eigen::Vector2d &a, const Eigen::Vector2d &b) const;

  /**
   * Length of the shortest way over free cells, at most 3 % more than the best.
   * @param a, b metres, world frame; taken to the nearest free cell within 0.25 m
   * @param limit metres; a longer way is no answer
   */
  std::optional<double> pathLength(const Eigen::Vector2d &a, const Eigen::Vector2d &b,
                                   double limit) const;

  /** Seen from above. */
  FloorPlan floorPlan() const;

  /** Where the body can stand. */
  const FloorGrid &grid() const { return m_grid; }

private:
  std::shared_ptr<const CollisionMap> m_map;
  FloorGrid m_grid;
  std::shared_ptr<const RayCaster> m_collisions;
  double m_eyeHeight;
  int m_region = 0;
  std::vector<Eigen::Vector2d> m_cells;
};

} // namespace homeward
