// SPDX-License-Identifier: GPL-3.0-or-later
#include "checker_grid.h"

#include "checker_corners.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <queue>

namespace homeward
{
namespace
{

/** Ways from a corner: along its rising edge, its falling one, and against them. */
constexpr std::size_t kWays = 4;

using Neighbours = std::array<std::optional<std::size_t>, kWays>;

bool alongRising(std::size_t way)
{
  return way % 2 == 0;
}

Eigen::Vector2d direction(const CheckerCorner &corner, std::size_t way)
{
  const Eigen::Vector2d &edge = alongRising(way) ? corner.rising : corner.falling;
  return way < 2 ? edge : Eigen::Vector2d(-edge);
}

/** The nearest corner that an edge leads to. */
std::optional<std::size_t> follow(const cv::Mat1b &smooth,
                                  const std::vector<CheckerCorner> &corners, std::size_t from,
                                  std::size_t way)
{
  constexpr double kLeastCosine = 0.94; // the edge and the way to the next corner
  constexpr double kFaintEdge = 0.2;    // of the corner's contrast
  const CheckerCorner &start = corners[from];
  const Eigen::Vector2d along = direction(start, way);
  std::vector<std::pair<double, std::size_t>> ahead;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d step = corners[i].pixel - start.pixel;
    const double length = step.norm();
    // The next corner has its dark sectors where this one has its bright ones.
    const Eigen::Vector2d &edge = alongRising(way) ? corners[i].falling : corners[i].rising;
    if (i != from && step.dot(along) > kLeastCosine * length &&
        std::abs(step.dot(edge)) > kLeastCosine * length) {
      ahead.emplace_back(length, i);
    }
  }
  constexpr std::size_t kTried = 3;
  const std::size_t tried = std::min(kTried, ahead.size());
  std::partial_sort(ahead.begin(), ahead.begin() + static_cast<long>(tried), ahead.end());
  for (std::size_t k = 0; k < tried; ++k) {
    const CheckerCorner &next = corners[ahead[k].second];
    if (joinedByEdge(smooth, start.pixel, next.pixel, alongRising(way),
                     kFaintEdge * start.contrast)) {
      return ahead[k].second;
    }
  }
  return std::nullopt;
}

/** Who is next to whom, where both say so. */
std::vector<Neighbours> neighbours(const cv::Mat1b &smooth,
                                   const std::vector<CheckerCorner> &corners)
{
  std::vector<Neighbours> next(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t way = 0; way < kWays; ++way) {
      next[i][way] = follow(smooth, corners, i, way);
    }
  }
  std::vector<Neighbours> mutual(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t way = 0; way < kWays; ++way) {
      const auto &other = next[i][way];
      if (other && std::count(next[*other].begin(), next[*other].end(), i) == 1) {
        mutual[i][way] = other;
      }
    }
  }
  return mutual;
}

/** A corner in a grid that grows, with the ways that lead along columns and rows. */
struct Placed
{
  std::size_t corner = 0;
  int column = 0;
  int row = 0;
  Eigen::Vector2d right; ///< to the next column, roughly
  Eigen::Vector2d down;  ///< to the next row, roughly
};

/** The neighbour that lies towards `where`, which is a column or a row away. */
Placed placedBeside(const Placed &placed, const std::vector<CheckerCorner> &corners,
                    std::size_t next, const Eigen::Vector2d &way)
{
  Placed result = placed;
  result.corner = next;
  const double right = way.dot(placed.right);
  const double down = way.dot(placed.down);
  const bool sideways = std::abs(right) > std::abs(down);
  (sideways ? result.column : result.row) += (sideways ? right : down) > 0.0 ? 1 : -1;
  const auto turned = [](const Eigen::Vector2d &edge, const Eigen::Vector2d &towards) {
    return Eigen::Vector2d(edge.dot(towards) > 0.0 ? edge : -edge);
  };
  // Rising and falling change places from each corner to the next.
  const CheckerCorner &corner = corners[next];
  const bool swap =
      std::abs(corner.rising.dot(placed.right)) < std::abs(corner.falling.dot(placed.right));
  result.right = turned(swap ? corner.falling : corner.rising, placed.right);
  result.down = turned(swap ? corner.rising : corner.falling, placed.down);
  return result;
}

/** The grid that grows from a corner; marks all that it meets. */
std::vector<GridCorner> grow(const std::vector<CheckerCorner> &corners,
                             const std::vector<Neighbours> &next, std::size_t seed,
                             std::vector<bool> &met)
{
  const CheckerCorner &first = corners[seed];
  const double turn = first.rising.x() * first.falling.y() - first.rising.y() * first.falling.x();
  std::queue<Placed> open;
  open.push(
      {seed, 0, 0, first.rising, turn > 0.0 ? first.falling : Eigen::Vector2d(-first.falling)});
  met[seed] = true;
  std::map<std::pair<int, int>, std::size_t> taken{{{0, 0}, seed}};
  while (!open.empty()) {
    const Placed placed = open.front();
    open.pop();
    for (std::size_t way = 0; way < kWays; ++way) {
      const auto &other = next[placed.corner][way];
      if (!other || met[*other]) {
        continue;
      }
      const Placed beside =
          placedBeside(placed, corners, *other, direction(corners[placed.corner], way));
      if (taken.emplace(std::pair(beside.column, beside.row), *other).second) {
        met[*other] = true;
        open.push(beside);
      }
    }
  }
  std::vector<GridCorner> grid;
  for (const auto &[place, corner] : taken) {
    grid.push_back({place.first, place.second, corners[corner].pixel});
  }
  return grid;
}

/** Corners with two neighbours in line and none across hang on by a thread: they go. */
void dropThreads(std::vector<GridCorner> &grid)
{
  for (;;) {
    const auto has = [&](int column, int row) {
      return std::any_of(grid.begin(), grid.end(), [&](const GridCorner &corner) {
        return corner.column == column && corner.row == row;
      });
    };
    std::vector<GridCorner> kept;
    for (const GridCorner &corner : grid) {
      const int c = corner.column;
      const int r = corner.row;
      bool square = false;
      for (const int dc : {-1, 1}) {
        for (const int dr : {-1, 1}) {
          square = square || (has(c + dc, r) && has(c, r + dr) && has(c + dc, r + dr));
        }
      }
      if (square) {
        kept.push_back(corner);
      }
    }
    if (kept.size() == grid.size()) {
      return;
    }
    grid = kept;
  }
}

/** Takes away the outer column or row with the fewest corners. */
void dropThinnestSide(std::vector<GridCorner> &grid, bool columns)
{
  const auto place = [columns](const GridCorner &corner) {
    return columns ? corner.column : corner.row;
  };
  const auto [low, high] =
      std::minmax_element(grid.begin(), grid.end(), [&](const GridCorner &a, const GridCorner &b) {
        return place(a) < place(b);
      });
  const int first = place(*low);
  const int last = place(*high);
  const auto count = [&](int side) {
    return std::count_if(grid.begin(), grid.end(),
                         [&](const GridCorner &corner) { return place(corner) == side; });
  };
  const int side = count(first) < count(last) ? first : last;
  std::erase_if(grid, [&](const GridCorner &corner) { return place(corner) == side; });
}

/** Counted from zero. */
void countFromZero(std::vector<GridCorner> &grid)
{
  int column = grid.front().column;
  int row = grid.front().row;
  for (const GridCorner &corner : grid) {
    column = std::min(column, corner.column);
    row = std::min(row, corner.row);
  }
  for (GridCorner &corner : grid) {
    corner.column -= column;
    corner.row -= row;
  }
}

/** A quarter turn; what were rows are columns. */
std::vector<GridCorner> turned(std::vector<GridCorner> grid)
{
  for (GridCorner &corner : grid) {
    corner = {-corner.row, corner.column, corner.pixel};
  }
  countFromZero(grid);
  return grid;
}

/** How far to the right the columns run. */
double rightwards(const std::vector<GridCorner> &grid)
{
  double mean = 0.0;
  for (const GridCorner &corner : grid) {
    mean += corner.column / static_cast<double>(grid.size());
  }
  double sum = 0.0;
  for (const GridCorner &corner : grid) {
    sum += (corner.column - mean) * corner.pixel.x();
  }
  return sum;
}

/** The grid without what is too much for the board, turned so that it fits and reads rightwards. */
std::vector<GridCorner> fitted(std::vector<GridCorner> grid, const GridSize &size)
{
  const int most = std::max(size.columns, size.rows);
  const int least = std::min(size.columns, size.rows);
  for (GridSize extent = extentOf(grid); std::max(extent.columns, extent.rows) > most ||
                                         std::min(extent.columns, extent.rows) > least;
       extent = extentOf(grid)) {
    const bool wide = extent.columns >= extent.rows;
    // The longer side shrinks while it is too long, then the shorter one.
    dropThinnestSide(grid, std::max(extent.columns, extent.rows) > most ? wide : !wide);
  }
  countFromZero(grid);
  std::optional<std::vector<GridCorner>> best;
  for (int i = 0; i < 4; ++i) {
    const GridSize extent = extentOf(grid);
    const bool fits = extent.columns <= size.columns && extent.rows <= size.rows;
    if (fits && (!best || rightwards(grid) > rightwards(*best))) {
      best = grid;
    }
    grid = turned(grid);
  }
  return best.value_or(std::vector<GridCorner>());
}

/** The grid of a picture that has more corners of the board than any other in it. */
std::vector<GridCorner> largestGrid(const cv::Mat1b &smooth, const GridSize &size)
{
  const std::vector<CheckerCorner> corners = checkerCorners(smooth);
  const std::vector<Neighbours> next = neighbours(smooth, corners);
  std::vector<bool> met(corners.size(), false);
  std::vector<GridCorner> largest;
  for (std::size_t seed = 0; seed < corners.size(); ++seed) {
    if (met[seed]) {
      continue;
    }
    std::vector<GridCorner> grid = grow(corners, next, seed, met);
    dropThreads(grid);
    if (grid.size() <= largest.size()) {
      continue;
    }
    grid = fitted(std::move(grid), size);
    if (grid.size() > largest.size()) {
      largest = std::move(grid);
    }
  }
  return largest;
}

} // namespace

GridSize extentOf(const std::vector<GridCorner> &grid)
{
  if (grid.empty()) {
    return {};
  }
  const auto [left, right] =
      std::minmax_element(grid.begin(), grid.end(), [](const GridCorner &a, const GridCorner &b) {
        return a.column < b.column;
      });
  const auto [top, bottom] =
      std::minmax_element(grid.begin(), grid.end(),
                          [](const GridCorner &a, const GridCorner &b) { return a.row < b.row; });
  return {right->column - left->column + 1, bottom->row - top->row + 1};
}

std::vector<GridCorner> findCheckerGrid(const cv::Mat1b &picture, const GridSize &size)
{
  constexpr int kSmallest = 300; // pixels of a side
  constexpr double kBlur = 1.0;
  std::vector<GridCorner> largest;
  cv::Mat1b image = picture;
  for (double scale = 1.0; std::min(image.cols, image.rows) >= kSmallest || scale == 1.0;
       scale *= 2.0) {
    cv::Mat1b smooth;
    cv::GaussianBlur(image, smooth, {}, kBlur);
    std::vector<GridCorner> grid = largestGrid(smooth, size);
    if (grid.size() > largest.size()) {
      for (GridCorner &corner : grid) {
        corner.pixel = (corner.pixel.array() + 0.5) * scale - 0.5;
      }
      largest = std::move(grid);
    }
    if (largest.size() == static_cast<std::size_t>(size.columns * size.rows)) {
      break;
    }
    cv::resize(image, image, {}, 0.5, 0.5, cv::INTER_AREA);
  }
  return largest;
}

} // namespace homeward
