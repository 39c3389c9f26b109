// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/free_space.h>

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>

namespace homeward
{

namespace
{

constexpr double kSnap = 0.25; // metres from a point to the cell that stands for it

/** A move on the grid, and the cells that it crosses besides its ends. */
struct Move
{
  cv::Point step;
  std::array<cv::Point, 2> crossed;
  double length; // cells
};

/** To the 8 neighbours and, to keep lengths true within 3 %, the 8 knight's moves. */
std::vector<Move> makeMoves()
{
  std::vector<Move> moves;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const int longer = std::max(std::abs(dx), std::abs(dy));
      const int shorter = std::min(std::abs(dx), std::abs(dy));
      if (longer == 1) {
        moves.push_back({{dx, dy}, {}, std::hypot(dx, dy)});
      }
      else if (longer == 2 && shorter == 1) {
        // A knight's move passes between a straight and a diagonal neighbour.
        const cv::Point diagonal{dx > 0 ? 1 : -1, dy > 0 ? 1 : -1};
        const cv::Point straight =
            std::abs(dx) == 2 ? cv::Point{diagonal.x, 0} : cv::Point{0, diagonal.y};
        moves.push_back({{dx, dy}, {diagonal, straight}, std::hypot(dx, dy)});
      }
    }
  }
  return moves;
}

bool passable(const FloorGrid &grid, const cv::Point &cell, const Move &move)
{
  return grid.freeCell(cell + move.step) &&
         std::all_of(move.crossed.begin(), move.crossed.end(),
                     [&](const cv::Point &crossed) { return grid.freeCell(cell + crossed); });
}

double distance(const cv::Point &a, const cv::Point &b)
{
  return std::hypot(a.x - b.x, a.y - b.y);
}

/** A* over free cells; all lengths in cells. */
std::optional<double> shortest(const FloorGrid &grid, const cv::Point &from, const cv::Point &to,
                               double limit)
{
  static const std::vector<Move> moves = makeMoves();
  const FloorRaster &raster = grid.raster();
  const auto index = [&](const cv::Point &cell) { return cell.y * raster.columns + cell.x; };
  cv::Mat best(raster.rows, raster.columns, CV_64FC1,
               cv::Scalar(std::numeric_limits<double>::infinity()));
  using Entry = std::pair<double, int>; // estimated total, cell
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  best.at<double>(from) = 0.0;
  open.emplace(distance(from, to), index(from));
  while (!open.empty()) {
    const auto [total, at] = open.top();
    open.pop();
    const cv::Point cell{at % raster.columns, at / raster.columns};
    const double length = best.at<double>(cell);
    if (cell == to) {
      return length;
    }
    if (total > length + distance(cell, to) + 1e-9) {
      continue;
    }
    for (const Move &move : moves) {
      const cv::Point next = cell + move.step;
      const double longer = length + move.length;
      const double estimate = longer + distance(next, to);
      if (estimate <= limit && passable(grid, cell, move) && longer < best.at<double>(next)) {
        best.at<double>(next) = longer;
        open.emplace(estimate, index(next));
      }
    }
  }
  return std::nullopt;
}

Eigen::Vector3f lift(const Eigen::Vector2d &point, double height)
{
  return Eigen::Vector3d(point.x(), point.y(), height).cast<float>();
}

} // namespace

FreeSpace::FreeSpace(std::shared_ptr<const CollisionMap> map, FloorGrid grid,
                     std::shared_ptr<const RayCaster> collisions, double eyeHeight,
                     const Eigen::Vector2d &start)
    : m_map(std::move(map)), m_grid(std::move(grid)), m_collisions(std::move(collisions)),
      m_eyeHeight(eyeHeight)
{
  const cv::Point first = m_grid.nearestFree(start, kSnap);
  if (m_grid.freeCell(first)) {
    m_region = m_grid.regions().at<int>(first);
    m_cells = reachableCells(start);
  }
}

std::vector<Eigen::Vector2d> FreeSpace::reachableCells(const Eigen::Vector2d &from) const
{
  std::vector<Eigen::Vector2d> cells;
  const cv::Point first = m_grid.nearestFree(from, kSnap);
  if (!m_grid.freeCell(first)) {
    return cells;
  }
  const int region = m_grid.regions().at<int>(first);
  for (int row = 0; row < m_grid.raster().rows; ++row) {
    for (int column = 0; column < m_grid.raster().columns; ++column) {
      if (m_grid.regions().at<int>(row, column) == region) {
        cells.push_back(m_grid.raster().centre({column, row}));
      }
    }
  }
  return cells;
}

bool FreeSpace::reachable(const Eigen::Vector2d &point) const
{
  const cv::Point cell = m_grid.raster().cell(point);
  return m_grid.freeCell(cell) && m_grid.regions().at<int>(cell) == m_region;
}

double FreeSpace::area() const
{
  const double resolution = m_grid.raster().resolution;
  return static_cast<double>(m_cells.size()) * resolution * resolution;
}

double FreeSpace::areaAround(const Eigen::Vector2d &point) const
{
  const double resolution = m_grid.raster().resolution;
  return static_cast<double>(reachableCells(point).size()) * resolution * resolution;
}

bool FreeSpace::sees(const Eigen::Vector2d &a, const Eigen::Vector2d &b) const
{
  return !m_collisions->blocked(lift(a, m_eyeHeight), lift(b, m_eyeHeight));
}

std::optional<double> FreeSpace::pathLength(const Eigen::Vector2d &a, const Eigen::Vector2d &b,
                                            double limit) const
{
  const cv::Point from = m_grid.nearestFree(a, kSnap);
  const cv::Point to = m_grid.nearestFree(b, kSnap);
  if (!m_grid.freeCell(from) || !m_grid.freeCell(to)) {
    return std::nullopt;
  }
  const double resolution = m_grid.raster().resolution;
  const std::optional<double> cells = shortest(m_grid, from, to, limit / resolution);
  return cells ? std::optional<double>(*cells * resolution) : std::nullopt;
}

FloorPlan FreeSpace::floorPlan() const
{
  constexpr unsigned char kReachable = 255;
  constexpr unsigned char kElsewhere = 190;
  const FloorRaster &raster = m_map->raster();
  FloorPlan plan;
  plan.origin = raster.origin;
  plan.resolution = raster.resolution;
  plan.image = cv::Mat(raster.rows, raster.columns, CV_8UC1, cv::Scalar(kElsewhere));
  for (int row = 0; row < raster.rows; ++row) {
    unsigned char *pixels = plan.image.ptr<unsigned char>(raster.rows - 1 - row);
    for (int column = 0; column < raster.columns; ++column) {
      if (m_map->obstacles().at<unsigned char>(row, column) != 0) {
        pixels[column] = 0;
      }
      else if (reachable(raster.centre({column, row}))) {
        pixels[column] = kReachable;
      }
    }
  }
  return plan;
}

} // namespace homeward
