// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/collision_map.h>

#include "height_band.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace homeward
{

namespace
{

constexpr double kCell = 0.02;        // metres
constexpr double kMostCells = 4000.0; // along a side
constexpr double kVisibleNear = 0.06; // metres between a contact and what the laser sees
constexpr double kLaserPlane = 0.005; // half the height of the laser's plane, metres

/** A raster of the bounds with free cells all round. */
FloorRaster rasterOver(const Eigen::AlignedBox2d &bounds)
{
  FloorRaster raster;
  if (bounds.isEmpty()) {
    return raster;
  }
  raster.resolution = std::max(kCell, bounds.sizes().maxCoeff() / kMostCells);
  const double margin = 2.0 * raster.resolution;
  raster.origin = bounds.min() - Eigen::Vector2d(margin, margin);
  const cv::Point last = raster.cell(bounds.max());
  raster.columns = last.x + 3;
  raster.rows = last.y + 3;
  return raster;
}

cv::Mat distanceTo(const cv::Mat &occupied)
{
  cv::Mat distance;
  const cv::Mat unmarked = occupied == 0;
  cv::distanceTransform(unmarked, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat cells;
  // Rounding to the nearest would overstate; half a cell less is rounding down.
  distance.convertTo(cells, CV_8UC1, 1.0, -0.5);
  return cells;
}

std::array<Eigen::Vector2d, 4> cornersOf(const BodyPart &shape, const Pose2 &wMr)
{
  return {
      wMr * Eigen::Vector2d(shape.xMin, shape.yMin), wMr * Eigen::Vector2d(shape.xMax, shape.yMin),
      wMr * Eigen::Vector2d(shape.xMax, shape.yMax), wMr * Eigen::Vector2d(shape.xMin, shape.yMax)};
}

/** Where the line y = `y` leaves a convex polygon of four corners. False when it misses it. */
bool crossing(const std::array<Eigen::Vector2d, 4> &corners, double y, double &left, double &right)
{
  left = std::numeric_limits<double>::infinity();
  right = -left;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i];
    const Eigen::Vector2d &b = corners[(i + 1) % corners.size()];
    if ((a.y() <= y) == (b.y() <= y)) {
      continue;
    }
    const double x = a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
    left = std::min(left, x);
    right = std::max(right, x);
  }
  return left <= right;
}

} // namespace

CollisionMap::CollisionMap(const RayCaster &collisions, const RobotDescription &robot)
{
  for (const BodyPart &shape : robot.body) {
    addPart(shape);
  }
  double top = kDriveableHeight;
  for (const Band &band : m_bands) {
    top = std::max(top, band.zMax);
  }
  const std::vector<Mesh> &meshes = collisions.meshes();
  m_bounds = boundsBetween(meshes, kDriveableHeight, top);
  m_raster = rasterOver(m_bounds);
  if (m_bounds.isEmpty()) {
    return;
  }
  m_obstacles = cv::Mat::zeros(m_raster.rows, m_raster.columns, CV_8UC1);
  for (Band &band : m_bands) {
    band.occupied = drawBetween(meshes, band.zMin, band.zMax, m_raster);
    fillSolids(collisions, (band.zMin + band.zMax) / 2.0, m_raster, band.occupied);
    band.distance = distanceTo(band.occupied);
    m_obstacles |= band.occupied;
  }
  const double laser = robot.rMl.translation().z();
  const cv::Mat seen = drawBetween(meshes, laser - kLaserPlane, laser + kLaserPlane, m_raster);
  m_laserVisible = distanceTo(seen) <= kVisibleNear / m_raster.resolution;
}

void CollisionMap::addPart(const BodyPart &shape)
{
  const double zMin = std::max(shape.zMin, kDriveableHeight);
  const double zMax = shape.zMax;
  if (zMax <= zMin) {
    return;
  }
  const auto same = std::find_if(m_bands.begin(), m_bands.end(), [&](const Band &band) {
    return band.zMin == zMin && band.zMax == zMax;
  });
  const double length = shape.xMax - shape.xMin;
  const double width = shape.yMax - shape.yMin;
  m_parts.push_back({shape, static_cast<std::size_t>(same - m_bands.begin()),
                     std::min(length, width) / 2.0, std::hypot(length, width) / 2.0});
  if (same == m_bands.end()) {
    m_bands.push_back({zMin, zMax, {}, {}});
  }
}

double CollisionMap::distanceToPart(const Part &part, const Pose2 &wMr) const
{
  const BodyPart &shape = part.shape;
  const cv::Point cell = m_raster.cell(
      wMr * Eigen::Vector2d((shape.xMin + shape.xMax) / 2.0, (shape.yMin + shape.yMax) / 2.0));
  return m_raster.contains(cell) ? m_bands[part.band].distance.at<unsigned char>(cell) : -1.0;
}

/** Calls visitor(cell) for each touched cell until it returns true; whether it did. */
template <class Visitor>
bool CollisionMap::visit(const Part &part, const Pose2 &wMr, Visitor visitor) const
{
  const double distance = distanceToPart(part, wMr);
  if (distance > part.outerRadius / m_raster.resolution + 1.0) {
    return false;
  }
  const std::array<Eigen::Vector2d, 4> corners = cornersOf(part.shape, wMr);
  const auto [low, high] =
      std::minmax({corners[0].y(), corners[1].y(), corners[2].y(), corners[3].y()});
  const int first = std::max(m_raster.cell({m_raster.origin.x(), low}).y, 0);
  const int last = std::min(m_raster.cell({m_raster.origin.x(), high}).y, m_raster.rows - 1);
  const cv::Mat &occupied = m_bands[part.band].occupied;
  const double scale = 1.0 / m_raster.resolution;
  for (int row = first; row <= last; ++row) {
    double left = 0.0;
    double right = 0.0;
    if (!crossing(corners, m_raster.centre({0, row}).y(), left, right)) {
      continue;
    }
    // Columns whose middle lies in [left, right].
    const int begin =
        std::max(static_cast<int>(std::ceil((left - m_raster.origin.x()) * scale - 0.5)), 0);
    const int end =
        std::min(static_cast<int>(std::floor((right - m_raster.origin.x()) * scale - 0.5)) + 1,
                 m_raster.columns);
    const unsigned char *cells = occupied.ptr<unsigned char>(row);
    for (int column = begin; column < end; ++column) {
      if (cells[column] != 0 && visitor(cv::Point(column, row))) {
        return true;
      }
    }
  }
  return false;
}

bool CollisionMap::touches(const Pose2 &wMr) const
{
  if (m_bounds.isEmpty()) {
    return false;
  }
  return std::any_of(m_parts.begin(), m_parts.end(), [&](const Part &part) {
    // The map counts from the cell's middle and in whole cells: two cells cover both.
    const double distance = distanceToPart(part, wMr);
    if (distance >= 0.0 && distance + 2.0 < part.innerRadius / m_raster.resolution) {
      return true;
    }
    return visit(part, wMr, [](const cv::Point &) { return true; });
  });
}

std::vector<Contact> CollisionMap::contacts(const Pose2 &wMr) const
{
  std::vector<Contact> found;
  if (m_bounds.isEmpty()) {
    return found;
  }
  for (const Part &part : m_parts) {
    visit(part, wMr, [&](const cv::Point &cell) {
      found.push_back({m_raster.centre(cell), m_laserVisible.at<unsigned char>(cell) != 0});
      return false;
    });
  }
  return found;
}

} // namespace homeward
