// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/floor_grid.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace homeward
{

namespace
{

constexpr double kCell = 0.05;          // metres
constexpr int kHeadings = 16;           // tried in each cell
constexpr double kSmallestHouse = 4.0;  // square metres
constexpr double kStartClearance = 0.5; // metres

bool fits(const CollisionMap &map, const Eigen::Vector2d &point)
{
  for (int i = 0; i < kHeadings; ++i) {
    if (!map.touches({point.x(), point.y(), wrapAngle(2.0 * kPi * i / kHeadings)})) {
      return true;
    }
  }
  return false;
}

/** The region to start in: 0 when there is none. */
int startRegion(const FloorGrid &grid)
{
  const cv::Mat &regions = grid.regions();
  double most = 0.0;
  cv::minMaxLoc(regions, nullptr, &most);
  std::vector<int> cells(static_cast<std::size_t>(most) + 1, 0);
  std::vector<bool> open(cells.size(), false);
  for (int row = 0; row < regions.rows; ++row) {
    for (int column = 0; column < regions.cols; ++column) {
      const auto region = static_cast<std::size_t>(regions.at<int>(row, column));
      ++cells[region];
      const bool edge =
          row == 0 || column == 0 || row == regions.rows - 1 || column == regions.cols - 1;
      open[region] = open[region] || edge;
    }
  }
  int largest = 0;
  int enclosed = 0;
  const auto size = [&](int region) {
    return region == 0 ? 0 : cells[static_cast<std::size_t>(region)];
  };
  for (int region = 1; region < static_cast<int>(cells.size()); ++region) {
    largest = size(region) > size(largest) ? region : largest;
    if (!open[static_cast<std::size_t>(region)] && size(region) > size(enclosed)) {
      enclosed = region;
    }
  }
  const double resolution = grid.raster().resolution;
  return size(enclosed) * resolution * resolution >= kSmallestHouse ? enclosed : largest;
}

} // namespace

FloorGrid::FloorGrid(const CollisionMap &map)
{
  const Eigen::AlignedBox2d &bounds = map.bounds();
  if (bounds.isEmpty()) {
    return;
  }
  m_raster.origin = bounds.min();
  m_raster.resolution = std::max(kCell, 2.0 * map.raster().resolution);
  m_raster.columns = static_cast<int>(std::ceil(bounds.sizes().x() / m_raster.resolution));
  m_raster.rows = static_cast<int>(std::ceil(bounds.sizes().y() / m_raster.resolution));
  m_free = cv::Mat::zeros(m_raster.rows, m_raster.columns, CV_8UC1);
  for (int row = 0; row < m_raster.rows; ++row) {
    for (int column = 0; column < m_raster.columns; ++column) {
      if (fits(map, m_raster.centre({column, row}))) {
        m_free.at<unsigned char>(row, column) = 255;
      }
    }
  }
  cv::connectedComponents(m_free, m_regions, 8, CV_32S);
}

bool FloorGrid::free(const Eigen::Vector2d &point) const
{
  return freeCell(m_raster.cell(point));
}

cv::Point FloorGrid::nearestFree(const Eigen::Vector2d &point, double reach) const
{
  const cv::Point middle = m_raster.cell(point);
  const int span = static_cast<int>(std::ceil(reach / m_raster.resolution));
  cv::Point nearest{-1, -1};
  double nearestDistance = reach;
  for (int row = middle.y - span; row <= middle.y + span; ++row) {
    for (int column = middle.x - span; column <= middle.x + span; ++column) {
      const cv::Point cell{column, row};
      const double distance = (m_raster.centre(cell) - point).norm();
      if (freeCell(cell) && distance <= nearestDistance) {
        nearest = cell;
        nearestDistance = distance;
      }
    }
  }
  return nearest;
}

Pose2 defaultStart(const CollisionMap &map, const FloorGrid &grid)
{
  const int region = map.bounds().isEmpty() ? 0 : startRegion(grid);
  if (region == 0) {
    throw ConfigError("the robot fits nowhere in this world: check that its walls and furniture "
                      "have collision geometry above the floor z = 0");
  }
  const cv::Mat inRegion = grid.regions() == region;
  cv::Mat clearance;
  // A frame of blocked cells, so that the edge of the world is kept away from too.
  cv::copyMakeBorder(inRegion, clearance, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(clearance, clearance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  double widest = 0.0;
  cv::minMaxLoc(clearance, nullptr, &widest);
  const double wanted = std::min(kStartClearance / grid.raster().resolution, widest);
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double bestDistance = std::numeric_limits<double>::infinity();
  for (int row = 0; row < inRegion.rows; ++row) {
    for (int column = 0; column < inRegion.cols; ++column) {
      const Eigen::Vector2d centre = grid.raster().centre({column, row});
      const bool wide = clearance.at<float>(row + 1, column + 1) >= wanted;
      if (wide && centre.norm() < bestDistance && !map.touches({centre.x(), centre.y(), 0.0})) {
        best = centre;
        bestDistance = centre.norm();
      }
    }
  }
  if (std::isinf(bestDistance)) {
    throw ConfigError("the robot fits in this world only where it is too narrow to turn: give a "
                      "start pose");
  }
  return {best.x(), best.y(), 0.0};
}

Pose2 defaultStart(const Scene &scene, const RobotDescription &robot)
{
  // The caster lives shorter than the scene, so it need not own it.
  const std::shared_ptr<const Scene> borrowed(std::shared_ptr<const Scene>{}, &scene);
  const CollisionMap map(RayCaster(borrowed, RayCaster::Layer::Collision), robot);
  return defaultStart(map, FloorGrid(map));
}

} // namespace homeward
