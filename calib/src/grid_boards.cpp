// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid_boards.h"

#include "board_map.h"
#include "checker_grid.h"
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

/** A board's points by their ids; what is not seen is empty. */
using Grid = std::vector<std::optional<BoardPixel>>;

/** Every disc of the grid, row by row, in the pixels of a view; empty where it is not seen. */
std::vector<cv::Point2f> findDiscs(const cv::Mat1b &image, const Target &target)
{
  cv::SimpleBlobDetector::Params params;
  params.minArea = 12.0F;
  params.maxArea = static_cast<float>(image.total()) / 50.0F;
  params.minConvexity = 0.85F;
  params.maxInertiaRatio = 1.1F;
  params.minInertiaRatio = 0.15F;
  params.minDistBetweenBlobs = 4.0F;
  std::vector<cv::Point2f> points;
  const bool found = cv::findCirclesGrid(image, {target.columns, target.rows}, points,
                                         cv::CALIB_CB_SYMMETRIC_GRID | cv::CALIB_CB_CLUSTERING,
                                         cv::SimpleBlobDetector::create(params));
  return found ? points : std::vector<cv::Point2f>();
}

std::size_t seen(const Grid &grid)
{
  return static_cast<std::size_t>(
      std::count_if(grid.begin(), grid.end(), [](const auto &point) { return point.has_value(); }));
}

/** The points of the grid next to a place on it, itself left out: all eight, or as many. */
std::vector<BoardPixel> around(const Grid &grid, const Target &target, std::size_t index)
{
  constexpr int kReach = 2; // at the border more to the other side
  constexpr std::size_t kMost = 8;
  const int column = static_cast<int>(index) % target.columns;
  const int row = static_cast<int>(index) / target.columns;
  std::vector<std::pair<int, std::size_t>> near;
  for (int r = std::max(0, row - kReach); r <= std::min(target.rows - 1, row + kReach); ++r) {
    for (int c = std::max(0, column - kReach); c <= std::min(target.columns - 1, column + kReach);
         ++c) {
      const auto i = static_cast<std::size_t>(r * target.columns + c);
      if (grid[i] && i != index) {
        near.emplace_back((r - row) * (r - row) + (c - column) * (c - column), i);
      }
    }
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMost));
  std::vector<BoardPixel> result;
  for (const auto &[distance, i] : near) {
    result.push_back(*grid[i]);
  }
  return result;
}

/** From the board to the picture round one of its points, which counts itself. */
std::optional<BoardMap> mapRound(const Grid &grid, const Target &target, std::size_t index,
                                 const UnifiedCamera &camera)
{
  std::vector<BoardPixel> points = around(grid, target, index);
  points.push_back(*grid[index]);
  return BoardMap::fit(camera, points);
}

/**
 * How far a point lies from where those round it say, and how far it is to the next one, pixels;
 * nothing where they do not say.
 */
struct Fit
{
  double aside = 0.0;
  double pitch = 0.0;
};

std::optional<Fit> fitOf(const Grid &grid, const Target &target, std::size_t index,
                         const UnifiedCamera &camera)
{
  const auto map = BoardMap::fit(camera, around(grid, target, index));
  if (!map) {
    return std::nullopt;
  }
  const BoardPixel &point = *grid[index];
  const Eigen::Vector2d expected = map->toPicture(point.board);
  const auto away = [&](double x, double y) {
    return (map->toPicture(point.board + target.pitch * Eigen::Vector2d(x, y)) - expected).norm();
  };
  return Fit{(point.pixel - expected).norm(), std::max(away(1.0, 0.0), away(0.0, 1.0))};
}

/** Whether the points lie as a flat grid's do, which a wrongly ordered one's do not. */
bool isFlat(const Grid &grid, const Target &target, const UnifiedCamera &camera)
{
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto fit = grid[i] ? fitOf(grid, target, i, camera) : Fit{};
    if (!fit || fit->aside > 0.3 * fit->pitch) {
      return false;
    }
  }
  return true;
}

/** What a board is looked for in. */
struct Search
{
  cv::Mat1b picture;
  Target target;
  UnifiedCamera camera; ///< roughly
};

/** The grid with its points refined, those that do not refine left out. */
Grid refinedGrid(const Search &search, const Grid &grid)
{
  const Target &target = search.target;
  const bool checkers = target.kind == TargetKind::Chessboard;
  Grid refined(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto map = grid[i] ? mapRound(grid, target, i, search.camera) : std::nullopt;
    if (!map) {
      continue;
    }
    const auto toPicture = [&](const Eigen::Vector2d &offset) {
      return map->toPicture(grid[i]->board + target.pitch * offset);
    };
    if (checkers && !showsWholeCheckers(search.picture, toPicture)) {
      continue;
    }
    constexpr double kReach = 0.42; // pitches; the next corner is one away
    const auto pixel = checkers ? refineSaddle(search.picture, toPicture, kReach)
                                : refineDisc(search.picture, toPicture);
    if (pixel) {
      refined[i] = BoardPixel{grid[i]->board, *pixel};
    }
  }
  return refined;
}

/** The points that refine well and lie where those round them say; nothing where few do. */
std::optional<BoardView> viewOf(const Search &search, const Grid &grid)
{
  const Grid refined = refinedGrid(search, grid);
  BoardView view;
  for (std::size_t i = 0; i < refined.size(); ++i) {
    const auto fit = refined[i] ? fitOf(refined, search.target, i, search.camera) : std::nullopt;
    if (fit && fit->aside < 0.7 + 0.03 * fit->pitch) {
      view.ids.push_back(static_cast<int>(i));
      view.board.emplace_back(refined[i]->board.x(), refined[i]->board.y(), 0.0);
      view.pixels.push_back(refined[i]->pixel);
    }
  }
  constexpr double kEnough = 0.7;     // of the grid; else it is none
  constexpr std::size_t kFewest = 12; // a part of 4 x 3 corners
  return view.ids.size() >= kFewest &&
                 static_cast<double>(view.ids.size()) >= kEnough * static_cast<double>(seen(grid))
             ? std::optional(view)
             : std::nullopt;
}

/** The grid of circles in a view of the picture. */
std::optional<BoardView> findCircles(const Search &search, const PictureView &view)
{
  const std::vector<cv::Point2f> found = findDiscs(view.image, search.target);
  if (found.empty()) {
    return std::nullopt;
  }
  const std::vector<Eigen::Vector3d> points = targetPoints(search.target);
  Grid grid;
  for (std::size_t i = 0; i < found.size(); ++i) {
    grid.push_back(BoardPixel{points[i].head<2>(), view.toPicture({found[i].x, found[i].y})});
  }
  return isFlat(grid, search.target, search.camera) ? viewOf(search, grid) : std::nullopt;
}

/** The chessboard, or as much of it as shows. */
std::optional<BoardView> findCheckers(const Search &search)
{
  const Target &target = search.target;
  const std::vector<GridCorner> corners =
      findCheckerGrid(search.picture, {target.columns, target.rows});
  const GridSize extent = extentOf(corners);
  if (std::max(extent.columns, extent.rows) < 4 || std::min(extent.columns, extent.rows) < 3) {
    return std::nullopt;
  }
  const std::vector<Eigen::Vector3d> points = targetPoints(target);
  Grid grid(points.size());
  for (const GridCorner &corner : corners) {
    const auto i = static_cast<std::size_t>(corner.row * target.columns + corner.column);
    grid[i] = BoardPixel{points[i].head<2>(), corner.pixel};
  }
  return viewOf(search, grid);
}

} // namespace

std::optional<BoardView> findGridBoard(const cv::Mat1b &picture, const Target &target,
                                       const std::optional<MirrorCircles> &mirror)
{
  const Search search{picture, target, roughCamera(mirror, picture.cols, picture.rows)};
  if (target.kind == TargetKind::Chessboard) {
    return findCheckers(search);
  }
  if (auto board = findCircles(search, enlarged(picture, 1.0))) {
    return board;
  }
  for (const PatchAim &aim : aimsRound(radians(85.0))) {
    constexpr double kScale = 1.5; // discs in pixels of their own, even near the rim
    if (auto board = findCircles(search, straightened(picture, search.camera, aim, kScale))) {
      return board;
    }
  }
  return std::nullopt;
}

} // namespace homeward
