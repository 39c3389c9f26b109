// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/floor_raster.h>
#include <homeward/sim/ray_caster.h>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace homeward
{

/**
 * What lies lower is floor to the wheels: thresholds, carpets, cables, a floor slab that does not
 * end exactly at z = 0. Metres; a Pioneer 3-AT climbs steps of twice that.
 */
inline constexpr double kDriveableHeight = 0.05;

/** A place where the body touches something. */
struct Contact
{
  Eigen::Vector2d point;     ///< metres, world frame
  bool laserVisible = false; ///< something stands in the laser's plane within 6 cm of it
};

/**
 * Where a robot's three-dimensional body would touch the world.
 *
 * For every range of heights that a body part fills, the collision geometry between those heights
 * is drawn into a raster of the floor, marking each cell that it enters. The floor is the plane
 * z = 0; what lies below kDriveableHeight is floor too. The inside of a closed solid counts as
 * touched. A part touches where a marked cell's middle lies in its rectangle, which is true to
 * about one cell.
 */
class CollisionMap
{
public:
  /**
   * Cells are 2 cm, larger where the world is wider than 80 m.
   * @param collisions over Layer::Collision of the world
   */
  CollisionMap(const RayCaster &collisions, const RobotDescription &robot);

  /** Whether the body at `wMr` touches anything. */
  bool touches(const Pose2 &wMr) const;

  /** Every cell that the body at `wMr` touches; empty where it is free. */
  std::vector<Contact> contacts(const Pose2 &wMr) const;

  /** Around everything finite that the body could touch; empty when there is no such thing. */
  const Eigen::AlignedBox2d &bounds() const { return m_bounds; }

  /** How its cells lie in the world. */
  const FloorRaster &raster() const { return m_raster; }

  /** CV_8UC1, row = cell.y: 255 where any part of the body could touch something. */
  const cv::Mat &obstacles() const { return m_obstacles; }

private:
  struct Band
  {
    double zMin;      ///< metres
    double zMax;      ///< metres
    cv::Mat occupied; ///< CV_8UC1, 255 where something stands
    cv::Mat distance; ///< CV_8UC1, cells to the nearest such cell, rounded down, 255 and more: 255
  };
  struct Part
  {
    BodyPart shape;
    std::size_t band;
    double innerRadius; ///< of the largest circle about its middle that it covers, metres
    double outerRadius; ///< of the smallest that covers it
  };

  template <class Visitor> bool visit(const Part &part, const Pose2 &wMr, Visitor visitor) const;
  /** From its middle to what stands at its heights, cells rounded down; -1 off the raster. */
  double distanceToPart(const Part &part, const Pose2 &wMr) const;
  void addPart(const BodyPart &shape);

  Eigen::AlignedBox2d m_bounds;
  FloorRaster m_raster;
  std::vector<Band> m_bands;
  std::vector<Part> m_parts;
  cv::Mat m_obstacles;
  cv::Mat m_laserVisible; ///< CV_8UC1, 255 near what stands in the laser's plane
};

} // namespace homeward
