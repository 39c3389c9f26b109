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
std::vector<GridPoint> grow(const std::vector<CheckerCorner> &corners,
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
  std::vector<GridPoint> grid;
  grid.reserve(taken.size());
  for (const auto &[place, corner] : taken) {
    grid.push_back({place.first, place.second, corners[corner].pixel});
  }
  return grid;
}

/** Corners with two neighbours in line and none across hang on by a thread: they go. */
void dropThreads(std::vector<GridPoint> &grid)
{
  for (;;) {
    const auto has = [&](int column, int row) {
      return std::any_of(grid.begin(), grid.end(), [&](const GridPoint &corner) {
        return corner.column == column && corner.row == row;
      });
    };
    std::vector<GridPoint> kept;
    for (const GridPoint &corner : grid) {
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

/** The grid of a picture that has more corners of the board than any other in it. */
std::vector<GridPoint> largestGrid(const cv::Mat1b &smooth, const GridSize &size)
{
  const std::vector<CheckerCorner> corners = checkerCorners(smooth);
  const std::vector<Neighbours> next = neighbours(smooth, corners);
  std::vector<bool> met(corners.size(), false);
  std::vector<GridPoint> largest;
  for (std::size_t seed = 0; seed < corners.size(); ++seed) {
    if (met[seed]) {
      continue;
    }
    std::vector<GridPoint> grid = grow(corners, next, seed, met);
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

std::vector<GridPoint> findCheckerGrid(const cv::Mat1b &picture, const GridSize &size)
{
  constexpr int kSmallest = 300; // pixels of a side
  constexpr double kBlur = 1.0;
  std::vector<GridPoint> largest;
  cv::Mat1b image = picture;
  for (double scale = 1.0; std::min(image.cols, image.rows) >= kSmallest || scale == 1.0;
       scale *= 2.0) {
    cv::Mat1b smooth;
    cv::GaussianBlur(image, smooth, {}, kBlur);
    std::vector<GridPoint> grid = largestGrid(smooth, size);
    if (grid.size() > largest.size()) {
      for (GridPoint &corner : grid) {
        corner.pixel = (corner.pixel.array() + 0.5) * scale - 0.5;
      }
      largest = std::move(grid);
    }
    if (largest.size() == size.points()) {
      break;
    }
    cv::resize(image, image, {}, 0.5, 0.5, cv::INTER_AREA);
  }
  return largest;
}

} // namespace homeward
