// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid_boards.h"

#include "board_map.h"
#include "checker_grid.h"
#include "disc_grid.h"
#include "picture_views.h"
#include "point_refinement.h"

#include <algorithm>

namespace homeward
{
namespace
{

/** A board's points by their ids; what is not seen is empty. */
using Grid = std::vector<std::optional<BoardPixel>>;

/** How many points the target's grid has. */
GridSize sizeOf(const Target &target)
{
  const int less = target.kind == TargetKind::Charuco ? 1 : 0; // inner corners of so many squares
  return {target.columns - less, target.rows - less};
}

std::size_t seen(const Grid &grid)
{
  return static_cast<std::size_t>(
      std::count_if(grid.begin(), grid.end(), [](const auto &point) { return point.has_value(); }));
}

/** The points of the grid next to a place on it, itself left out: all eight, or as many. */
std::vector<BoardPixel> around(const Grid &grid, const GridSize &size, std::size_t index)
{
  constexpr int kReach = 2; // at the border more to the other side
  constexpr std::size_t kMost = 8;
  const int column = static_cast<int>(index) % size.columns;
  const int row = static_cast<int>(index) / size.columns;
  std::vector<std::pair<int, std::size_t>> near;
  for (int r = std::max(0, row - kReach); r <= std::min(size.rows - 1, row + kReach); ++r) {
    for (int c = std::max(0, column - kReach); c <= std::min(size.columns - 1, column + kReach);
         ++c) {
      const std::size_t i = size.index(c, r);
      if (grid[i] && i != index) {
        near.emplace_back((r - row) * (r - row) + (c - column) * (c - column), i);
      }
    }
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMost));
  std::vector<BoardPixel> result;
  result.reserve(near.size() + 1);
  for (const auto &[distance, i] : near) {
    result.push_back(*grid[i]);
  }
  return result;
}

/** From the board to the picture round one of its points, which counts itself. */
std::optional<BoardMap> mapRound(const Grid &grid, const Target &target, std::size_t index,
                                 const UnifiedCamera &camera)
{
  std::vector<BoardPixel> points = around(grid, sizeOf(target), index);
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
  const auto map = BoardMap::fit(camera, around(grid, sizeOf(target), index));
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

/** What a board is looked for in. */
struct Search
{
  cv::Mat1b picture;
  Target target;
  UnifiedCamera camera; ///< roughly
};

/** A point of the grid to a fraction of a pixel; nothing where it is not what it seemed. */
std::optional<Eigen::Vector2d> refinedPoint(const Search &search, const Grid &grid, std::size_t i)
{
  const Target &target = search.target;
  const auto map = mapRound(grid, target, i, search.camera);
  if (!map) {
    return std::nullopt;
  }
  const auto toPicture = [&](const Eigen::Vector2d &offset) {
    return map->toPicture(grid[i]->board + target.pitch * offset);
  };
  if (target.kind == TargetKind::CircleGrid) {
    return refineDisc(search.picture, toPicture);
  }
  return refineCorner(search.picture, target, toPicture);
}

/** The grid with its points refined, those that do not refine left out. */
Grid refinedGrid(const Search &search, const Grid &grid)
{
  Grid refined(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto pixel = grid[i] ? refinedPoint(search, grid, i) : std::nullopt;
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

/** The board's points where the grid has them; nothing where less than a part of 4 x 3 shows. */
std::optional<Grid> boardOf(const std::vector<GridPoint> &found, const Target &target,
                            const PictureView &view)
{
  const GridSize extent = extentOf(found);
  if (std::max(extent.columns, extent.rows) < 4 || std::min(extent.columns, extent.rows) < 3) {
    return std::nullopt;
  }
  const std::vector<Eigen::Vector3d> points = targetPoints(target);
  Grid grid(points.size());
  for (const GridPoint &point : found) {
    const std::size_t i = sizeOf(target).index(point.column, point.row);
    grid[i] = BoardPixel{points[i].head<2>(), view.toPicture(point.pixel)};
  }
  return grid;
}

/** The grid of circles in a view of the picture, or as much of it as shows. */
std::optional<BoardView> findCircles(const Search &search, const PictureView &view)
{
  const GridSize size{search.target.columns, search.target.rows};
  const auto grid = boardOf(findDiscGrid(view.image, size), search.target, view);
  return grid ? viewOf(search, *grid) : std::nullopt;
}

/** The chessboard, or as much of it as shows. */
std::optional<BoardView> findCheckers(const Search &search)
{
  const GridSize size{search.target.columns, search.target.rows};
  const auto grid =
      boardOf(findCheckerGrid(search.picture, size), search.target, enlarged(search.picture, 1.0));
  return grid ? viewOf(search, *grid) : std::nullopt;
}

} // namespace

std::optional<BoardView> findGridBoard(const cv::Mat1b &picture, const Target &target,
                                       const std::optional<MirrorCircles> &mirror)
{
  const Search search{picture, target, roughCamera(mirror, picture.cols, picture.rows)};
  if (target.kind == TargetKind::Chessboard) {
    return findCheckers(search);
  }
  for (const double scale : {1.0, 2.0}) { // small discs need room for their rims
    if (auto board = findCircles(search, enlarged(picture, scale))) {
      return board;
    }
  }
  return std::nullopt;
}

std::optional<Eigen::Vector2d> refineCorner(const cv::Mat1b &picture, const Target &target,
                                            const ToPicture &toPicture)
{
  double reach = 0.42; // pitches; the next corner is one away
  if (target.kind == TargetKind::Charuco) {
    const double gap = (target.pitch - target.markerSide()) / 2.0;
    const double cell = target.markerSide() / 7.0; // a marker's border is the same on both sides
    reach = std::min(reach, (gap + cell) / target.pitch);
  }
  return refineSaddle(picture, toPicture, reach);
}

BoardView refineGridPoints(const cv::Mat1b &picture, const Target &target, const BoardView &view,
                           const UnifiedCamera &camera)
{
  Grid grid(targetPoints(target).size());
  for (std::size_t k = 0; k < view.ids.size(); ++k) {
    grid[static_cast<std::size_t>(view.ids[k])] =
        BoardPixel{view.board[k].head<2>(), view.pixels[k]};
  }
  const Search search{picture, target, camera};
  BoardView refined = view;
  for (std::size_t k = 0; k < view.ids.size(); ++k) {
    const auto pixel = refinedPoint(search, grid, static_cast<std::size_t>(view.ids[k]));
    constexpr double kFarthest = 0.5; // pixels; what moves farther was disturbed both times
    if (pixel && (*pixel - view.pixels[k]).norm() < kFarthest) {
      refined.pixels[k] = *pixel;
    }
  }
  return refined;
}

} // namespace homeward
