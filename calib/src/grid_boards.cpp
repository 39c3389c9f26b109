// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid_boards.h"

#include "board_map.h"
#include "picture_views.h"
#include "point_refinement.h"

#include <homeward/core/angle.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

#include <algorithm>

namespace homeward
{
namespace
{

/** Every point of the grid, row by row, in the pixels of a view; empty where it is not seen. */
std::vector<cv::Point2f> findGrid(const cv::Mat1b &image, const Target &target)
{
  const cv::Size size(target.columns, target.rows);
  std::vector<cv::Point2f> points;
  bool found = false;
  if (target.kind == TargetKind::Chessboard) {
    found = cv::findChessboardCornersSB(image, size, points, cv::CALIB_CB_NORMALIZE_IMAGE);
  }
  else {
    cv::SimpleBlobDetector::Params params;
    params.minArea = 12.0F;
    params.maxArea = static_cast<float>(image.total()) / 50.0F;
    params.minConvexity = 0.85F;
    params.maxInertiaRatio = 1.1F;
    params.minInertiaRatio = 0.15F;
    params.minDistBetweenBlobs = 4.0F;
    found = cv::findCirclesGrid(image, size, points,
                                cv::CALIB_CB_SYMMETRIC_GRID | cv::CALIB_CB_CLUSTERING,
                                cv::SimpleBlobDetector::create(params));
  }
  return found ? points : std::vector<cv::Point2f>();
}

/** Indices of the nine points of the grid round one of them. */
std::vector<std::size_t> around(const Target &target, int index)
{
  const int column = index % target.columns;
  const int row = index / target.columns;
  // At the border more to the other side, so that nine points speak everywhere.
  const int left = std::clamp(column - 1, 0, target.columns - 3);
  const int top = std::clamp(row - 1, 0, target.rows - 3);
  std::vector<std::size_t> result;
  for (int r = top; r < top + 3; ++r) {
    for (int c = left; c < left + 3; ++c) {
      result.push_back(static_cast<std::size_t>(r * target.columns + c));
    }
  }
  return result;
}

/** The grid round one of its points, itself included. */
std::vector<BoardPixel> neighbours(const std::vector<BoardPixel> &grid, const Target &target,
                                   int index)
{
  std::vector<BoardPixel> result;
  for (const std::size_t i : around(target, index)) {
    result.push_back(grid[i]);
  }
  return result;
}

/** Whether the points lie as a flat grid's do, which a wrongly ordered one's do not. */
bool isFlat(const std::vector<BoardPixel> &grid, const Target &target, const UnifiedCamera &camera)
{
  for (int i = 0; i < static_cast<int>(grid.size()); ++i) {
    const auto map = BoardMap::fit(camera, neighbours(grid, target, i));
    const BoardPixel &point = grid[static_cast<std::size_t>(i)];
    const auto aside = [&](double x, double y) {
      return map->toPicture(point.board + target.pitch * Eigen::Vector2d(x, y));
    };
    if (!map || (aside(0.0, 0.0) - point.pixel).norm() >
                    0.2 * std::max((aside(1.0, 0.0) - aside(0.0, 0.0)).norm(),
                                   (aside(0.0, 1.0) - aside(0.0, 0.0)).norm())) {
      return false;
    }
  }
  return true;
}

/** The grid with its points refined, those that do not refine left out. */
std::vector<std::optional<BoardPixel>> refinedGrid(const cv::Mat1b &picture, const Target &target,
                                                   const std::vector<BoardPixel> &grid,
                                                   const UnifiedCamera &camera)
{
  std::vector<std::optional<BoardPixel>> refined(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto map = BoardMap::fit(camera, neighbours(grid, target, static_cast<int>(i)));
    if (!map) {
      continue;
    }
    const auto toPicture = [&](const Eigen::Vector2d &offset) {
      return map->toPicture(grid[i].board + target.pitch * offset);
    };
    constexpr double kReach = 0.42; // pitches; the next corner is one away
    const auto pixel = target.kind == TargetKind::Chessboard
                           ? refineSaddle(picture, toPicture, kReach)
                           : refineDisc(picture, toPicture);
    if (pixel) {
      refined[i] = BoardPixel{grid[i].board, *pixel};
    }
  }
  return refined;
}

/** Whether a refined point lies where those round it say. */
bool fitsIn(const std::vector<std::optional<BoardPixel>> &refined, const Target &target,
            const UnifiedCamera &camera, std::size_t index)
{
  std::vector<BoardPixel> others;
  for (const std::size_t i : around(target, static_cast<int>(index))) {
    if (i != index && refined[i]) {
      others.push_back(*refined[i]);
    }
  }
  const auto map = BoardMap::fit(camera, others);
  if (!map) {
    return false;
  }
  const BoardPixel &point = *refined[index];
  const Eigen::Vector2d expected = map->toPicture(point.board);
  const double pitch =
      (map->toPicture(point.board + Eigen::Vector2d(target.pitch, 0.0)) - expected).norm();
  return (point.pixel - expected).norm() < 0.7 + 0.03 * pitch;
}

/** The points that refine well; nothing where too few do for the grid to be true. */
std::optional<BoardView> viewOf(const std::vector<std::optional<BoardPixel>> &refined,
                                const Target &target, const UnifiedCamera &camera)
{
  BoardView view;
  for (std::size_t i = 0; i < refined.size(); ++i) {
    if (refined[i] && fitsIn(refined, target, camera, i)) {
      view.ids.push_back(static_cast<int>(i));
      view.board.emplace_back(refined[i]->board.x(), refined[i]->board.y(), 0.0);
      view.pixels.push_back(refined[i]->pixel);
    }
  }
  constexpr double kEnough = 0.8;
  return static_cast<double>(view.ids.size()) >= kEnough * static_cast<double>(refined.size())
             ? std::optional(view)
             : std::nullopt;
}

std::optional<BoardView> findIn(const PictureView &view, const cv::Mat1b &picture,
                                const Target &target, const UnifiedCamera &camera)
{
  const std::vector<cv::Point2f> found = findGrid(view.image, target);
  if (found.empty()) {
    return std::nullopt;
  }
  const std::vector<Eigen::Vector3d> points = targetPoints(target);
  std::vector<BoardPixel> grid;
  for (std::size_t i = 0; i < found.size(); ++i) {
    grid.push_back({points[i].head<2>(), view.toPicture({found[i].x, found[i].y})});
  }
  if (!isFlat(grid, target, camera)) {
    return std::nullopt;
  }
  return viewOf(refinedGrid(picture, target, grid, camera), target, camera);
}

} // namespace

std::optional<BoardView> findGridBoard(const cv::Mat1b &picture, const Target &target,
                                       const std::optional<MirrorCircles> &mirror)
{
  const UnifiedCamera camera = roughCamera(mirror, picture.cols, picture.rows);
  if (auto board = findIn(enlarged(picture, 1.0), picture, target, camera)) {
    return board;
  }
  for (const PatchAim &aim : aimsRound(radians(85.0))) {
    constexpr double kScale = 1.5; // corners in pixels of their own, even near the rim
    if (auto board = findIn(straightened(picture, camera, aim, kScale), picture, target, camera)) {
      return board;
    }
  }
  return std::nullopt;
}

} // namespace homeward
