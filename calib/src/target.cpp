// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/target.h>

#include "markers.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward
{
namespace
{

constexpr double kDiscRadius = 0.25; ///< of the pitch

constexpr std::array<std::pair<TargetKind, const char *>, 4> kNames{
    {{TargetKind::Chessboard, "chessboard"},
     {TargetKind::CircleGrid, "circles"},
     {TargetKind::AprilGrid, "aprilgrid"},
     {TargetKind::Charuco, "charuco"}}};

/** Whether the square of a ChArUco board or chessboard is black. */
bool blackSquare(int column, int row)
{
  return (column + row) % 2 == 0;
}

/** The black cells of a marker whose top left corner stands at `corner`. */
void drawMarker(const MarkerCells &cells, double side, const Eigen::Vector2d &corner,
                std::vector<ArtRectangle> &rectangles)
{
  const double cell = side / static_cast<double>(cells.rows());
  for (Eigen::Index row = 0; row < cells.rows(); ++row) {
    for (Eigen::Index column = 0; column < cells.cols();) {
      Eigen::Index end = column;
      while (end < cells.cols() && cells(row, end) == 0.0) {
        ++end;
      }
      if (end > column) {
        rectangles.push_back({corner.x() + static_cast<double>(column) * cell,
                              corner.y() + static_cast<double>(row) * cell,
                              static_cast<double>(end - column) * cell, cell});
      }
      column = std::max(end, column + 1);
    }
  }
}

void drawSquares(int columns, int rows, double pitch, TargetArt &art)
{
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (blackSquare(column, row)) {
        art.rectangles.push_back({art.origin.x() + (column - 1) * pitch,
                                  art.origin.y() + (row - 1) * pitch, pitch, pitch});
      }
    }
  }
}

} // namespace

std::string nameOf(TargetKind kind)
{
  return std::find_if(kNames.begin(), kNames.end(),
                      [&](auto &entry) { return entry.first == kind; })
      ->second;
}

TargetKind targetKindOf(const std::string &name)
{
  for (const auto &[kind, known] : kNames) {
    if (name == known) {
      return kind;
    }
  }
  throw ConfigError("there is no target '" + name +
                    "'; there are chessboard, circles, aprilgrid and charuco");
}

void checkTarget(const Target &target)
{
  const bool marked = target.kind == TargetKind::AprilGrid || target.kind == TargetKind::Charuco;
  const int least = target.kind == TargetKind::AprilGrid ? 1 : 3;
  const std::string what = "a " + nameOf(target.kind) + " target of " +
                           std::to_string(target.columns) + " x " + std::to_string(target.rows);
  if (target.columns < least || target.rows < least || target.columns > 100 || target.rows > 100) {
    throw ConfigError(what + " is impossible; each way it needs " + std::to_string(least) +
                      " to 100");
  }
  if (!(target.pitch > 0.0) || !std::isfinite(target.pitch)) {
    throw ConfigError(what + " needs a pitch above 0 m, not " + std::to_string(target.pitch));
  }
  if (!marked) {
    return;
  }
  if (!(target.markerSide() > 0.2 * target.pitch && target.markerSide() < 0.95 * target.pitch)) {
    throw ConfigError(what + " with a pitch of " + std::to_string(target.pitch) +
                      " m needs markers of 0.2 to 0.95 times that, not " +
                      std::to_string(target.marker) + " m");
  }
  const auto markers = static_cast<int>(markerCorners(target).size());
  if (markers > dictionaryOf(target.kind)->bytesList.rows) {
    throw ConfigError(what + " needs " + std::to_string(markers) + " markers, there are " +
                      std::to_string(dictionaryOf(target.kind)->bytesList.rows));
  }
}

std::vector<Eigen::Vector2d> markerCorners(const Target &target)
{
  std::vector<Eigen::Vector2d> corners;
  const double gap = (target.pitch - target.markerSide()) / 2.0;
  for (int row = 0; row < target.rows; ++row) {
    for (int column = 0; column < target.columns; ++column) {
      if (target.kind == TargetKind::AprilGrid) {
        corners.emplace_back(column * target.pitch, row * target.pitch);
      }
      else if (target.kind == TargetKind::Charuco && !blackSquare(column, row)) {
        corners.emplace_back((column - 1) * target.pitch + gap, (row - 1) * target.pitch + gap);
      }
    }
  }
  return corners;
}

std::vector<Eigen::Vector3d> targetPoints(const Target &target)
{
  std::vector<Eigen::Vector3d> points;
  if (target.kind == TargetKind::AprilGrid) {
    const double side = target.markerSide();
    for (const Eigen::Vector2d &corner : markerCorners(target)) {
      points.emplace_back(corner.x(), corner.y(), 0.0);
      points.emplace_back(corner.x() + side, corner.y(), 0.0);
      points.emplace_back(corner.x() + side, corner.y() + side, 0.0);
      points.emplace_back(corner.x(), corner.y() + side, 0.0);
    }
    return points;
  }
  const int less = target.kind == TargetKind::Charuco ? 1 : 0; // squares have inner corners
  for (int row = 0; row < target.rows - less; ++row) {
    for (int column = 0; column < target.columns - less; ++column) {
      points.emplace_back(column * target.pitch, row * target.pitch, 0.0);
    }
  }
  return points;
}

TargetArt drawTarget(const Target &target)
{
  checkTarget(target);
  const double pitch = target.pitch;
  const double margin = 0.6 * pitch;
  TargetArt art;
  const auto cover = [&](double left, double across, double down) {
    art.origin = Eigen::Vector2d::Constant(margin + left);
    art.width = across + 2.0 * margin;
    art.height = down + 2.0 * margin;
  };
  switch (target.kind) {
  case TargetKind::Chessboard:
    cover(pitch, (target.columns + 1) * pitch, (target.rows + 1) * pitch);
    drawSquares(target.columns + 1, target.rows + 1, pitch, art);
    break;
  case TargetKind::Charuco:
    cover(pitch, target.columns * pitch, target.rows * pitch);
    drawSquares(target.columns, target.rows, pitch, art);
    break;
  case TargetKind::CircleGrid:
    cover(0.5 * pitch, target.columns * pitch, target.rows * pitch);
    for (const Eigen::Vector3d &point : targetPoints(target)) {
      art.discs.push_back(
          {art.origin.x() + point.x(), art.origin.y() + point.y(), kDiscRadius * pitch});
    }
    break;
  case TargetKind::AprilGrid:
    cover(0.0, (target.columns - 1) * pitch + target.markerSide(),
          (target.rows - 1) * pitch + target.markerSide());
    break;
  }
  int id = 0;
  for (const Eigen::Vector2d &corner : markerCorners(target)) {
    drawMarker(markerCells(target.kind, id++), target.markerSide(), art.origin + corner,
               art.rectangles);
  }
  return art;
}

} // namespace homeward
