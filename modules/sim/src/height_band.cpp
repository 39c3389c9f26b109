// SPDX-License-Identifier: GPL-3.0-or-later
#include "height_band.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace homeward
{

namespace
{

/** A convex polygon of few corners: a triangle cut by planes. */
struct Polygon
{
  std::array<Eigen::Vector3d, 9> corners;
  std::size_t size = 0;

  void add(const Eigen::Vector3d &corner) { corners[size++] = corner; }
};

/** The part of a polygon where sign * (point[axis] - limit) >= 0 (Sutherland and Hodgman). */
Polygon cut(const Polygon &polygon, int axis, double limit, double sign)
{
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Eigen::Vector3d &a = polygon.corners[i];
    const Eigen::Vector3d &b = polygon.corners[(i + 1) % polygon.size];
    const double insideA = sign * (a[axis] - limit);
    const double insideB = sign * (b[axis] - limit);
    if (insideA >= 0.0) {
      kept.add(a);
    }
    if ((insideA >= 0.0) != (insideB >= 0.0)) {
      kept.add(a + (b - a) * (insideA / (insideA - insideB)));
    }
  }
  return kept;
}

Polygon between(const Mesh &mesh, const Eigen::Vector3i &triangle, double zMin, double zMax)
{
  Polygon polygon;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d corner =
        mesh.vertices[static_cast<std::size_t>(triangle[i])].cast<double>();
    low = std::min(low, corner.z());
    high = std::max(high, corner.z());
    polygon.add(corner);
  }
  if (high < zMin || low > zMax) {
    return {};
  }
  if (low >= zMin && high <= zMax) {
    return polygon;
  }
  return cut(cut(polygon, 2, zMin, 1.0), 2, zMax, -1.0);
}

Eigen::AlignedBox3d boxOf(const Polygon &polygon)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    box.extend(polygon.corners[i]);
  }
  return box;
}

/** Marks every cell that the polygon's shadow on the floor enters. */
void draw(const Polygon &polygon, const FloorRaster &raster, cv::Mat &occupied)
{
  if (polygon.size == 0) {
    return;
  }
  const Eigen::AlignedBox3d box = boxOf(polygon);
  const int first = std::max(raster.cell(box.min().head<2>()).y, 0);
  const int last = std::min(raster.cell(box.max().head<2>()).y, raster.rows - 1);
  for (int row = first; row <= last; ++row) {
    const double low = raster.origin.y() + row * raster.resolution;
    const Polygon strip =
        first == last ? polygon : cut(cut(polygon, 1, low, 1.0), 1, low + raster.resolution, -1.0);
    if (strip.size == 0) {
      continue;
    }
    const Eigen::AlignedBox3d span = boxOf(strip);
    const int left = std::max(raster.cell(span.min().head<2>()).x, 0);
    const int right = std::min(raster.cell(span.max().head<2>()).x, raster.columns - 1);
    if (left <= right) {
      occupied.row(row).colRange(left, right + 1).setTo(255);
    }
  }
}

bool meetsBack(const RayCaster &collisions, const Eigen::Vector3f &origin,
               const Eigen::Vector3f &direction)
{
  const auto hit = collisions.hit(origin, direction, std::numeric_limits<float>::infinity());
  if (!hit) {
    return false;
  }
  const Mesh &mesh = collisions.meshes()[static_cast<std::size_t>(hit->mesh)];
  const Eigen::Vector3i &triangle = mesh.triangles[static_cast<std::size_t>(hit->triangle)];
  const Eigen::Vector3f &a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
  const Eigen::Vector3f &b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
  const Eigen::Vector3f &c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
  return (b - a).cross(c - a).dot(direction) > 0.0F;
}

bool insideSolid(const RayCaster &collisions, const Eigen::Vector3f &point)
{
  const std::array<Eigen::Vector3f, 5> directions{
      Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX(), -Eigen::Vector3f::UnitX(),
      Eigen::Vector3f::UnitY(), -Eigen::Vector3f::UnitY()};
  return std::all_of(directions.begin(), directions.end(), [&](const Eigen::Vector3f &direction) {
    return meetsBack(collisions, point, direction);
  });
}

/** A cell amid each labelled patch: the middle one of its cells in reading order. */
std::vector<cv::Point> middleCells(const cv::Mat &labels, const cv::Mat &stats)
{
  std::vector<cv::Point> cells(static_cast<std::size_t>(stats.rows));
  std::vector<int> seen(cells.size(), 0);
  for (int row = 0; row < labels.rows; ++row) {
    const int *label = labels.ptr<int>(row);
    for (int column = 0; column < labels.cols; ++column) {
      const auto index = static_cast<std::size_t>(label[column]);
      if (seen[index]++ == stats.at<int>(label[column], cv::CC_STAT_AREA) / 2) {
        cells[index] = {column, row};
      }
    }
  }
  return cells;
}

bool reachesBorder(const int *stats, const FloorRaster &raster)
{
  return stats[cv::CC_STAT_LEFT] == 0 || stats[cv::CC_STAT_TOP] == 0 ||
         stats[cv::CC_STAT_LEFT] + stats[cv::CC_STAT_WIDTH] == raster.columns ||
         stats[cv::CC_STAT_TOP] + stats[cv::CC_STAT_HEIGHT] == raster.rows;
}

} // namespace

Eigen::AlignedBox2d boundsBetween(const std::vector<Mesh> &meshes, double zMin, double zMax)
{
  Eigen::AlignedBox2d bounds;
  for (const Mesh &mesh : meshes) {
    if (mesh.infinite) {
      continue;
    }
    for (const Eigen::Vector3i &triangle : mesh.triangles) {
      const Polygon polygon = between(mesh, triangle, zMin, zMax);
      for (std::size_t i = 0; i < polygon.size; ++i) {
        bounds.extend(polygon.corners[i].head<2>().eval());
      }
    }
  }
  return bounds;
}

cv::Mat drawBetween(const std::vector<Mesh> &meshes, double zMin, double zMax,
                    const FloorRaster &raster)
{
  cv::Mat occupied = cv::Mat::zeros(raster.rows, raster.columns, CV_8UC1);
  for (const Mesh &mesh : meshes) {
    for (const Eigen::Vector3i &triangle : mesh.triangles) {
      draw(between(mesh, triangle, zMin, zMax), raster, occupied);
    }
  }
  return occupied;
}

void fillSolids(const RayCaster &collisions, double z, const FloorRaster &raster, cv::Mat &occupied)
{
  constexpr double kLargestSolid = 20.0; // square metres
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const cv::Mat unmarked = occupied == 0;
  cv::connectedComponentsWithStats(unmarked, labels, stats, centroids, 4, CV_32S);
  const std::vector<cv::Point> middles = middleCells(labels, stats);
  const double cellArea = raster.resolution * raster.resolution;
  std::vector<bool> solid(middles.size(), false);
  for (std::size_t label = 1; label < middles.size(); ++label) {
    const int *patch = stats.ptr<int>(static_cast<int>(label));
    if (reachesBorder(patch, raster) || patch[cv::CC_STAT_AREA] * cellArea >= kLargestSolid) {
      continue;
    }
    const Eigen::Vector2d middle = raster.centre(middles[label]);
    solid[label] =
        insideSolid(collisions, Eigen::Vector3d(middle.x(), middle.y(), z).cast<float>());
  }
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      if (solid[static_cast<std::size_t>(labels.at<int>(row, column))]) {
        occupied.at<unsigned char>(row, column) = 255;
      }
    }
  }
}

} // namespace homeward
