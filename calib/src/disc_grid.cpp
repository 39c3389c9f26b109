// SPDX-License-Identifier: GPL-3.0-or-later
#include "disc_grid.h"

#include <opencv2/features2d.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace homeward
{
namespace
{

/** A dark blob. */
struct Disc
{
  Eigen::Vector2d pixel;
  double width = 0.0; ///< pixels
};

std::vector<Disc> findDiscs(const cv::Mat1b &picture)
{
  cv::SimpleBlobDetector::Params params;
  params.minThreshold = 15.0F;
  params.minArea = 10.0F;
  params.maxArea = static_cast<float>(picture.total()) / 200.0F;
  params.minConvexity = 0.8F;
  params.maxInertiaRatio = 1.1F;
  params.minInertiaRatio = 0.1F;
  params.minDistBetweenBlobs = 4.0F;
  std::vector<cv::KeyPoint> points;
  cv::SimpleBlobDetector::create(params)->detect(picture, points);
  std::vector<Disc> discs;
  discs.reserve(points.size());
  for (const cv::KeyPoint &point : points) {
    discs.push_back({{point.pt.x, point.pt.y}, point.size});
  }
  return discs;
}

bool alike(const Disc &a, const Disc &b)
{
  constexpr double kMost = 1.5; // from one disc to the next the mirror changes less
  return a.width < kMost * b.width && b.width < kMost * a.width;
}

/** The discs nearest to one, those that look like it. */
std::vector<std::size_t> nearest(const std::vector<Disc> &discs, std::size_t to)
{
  constexpr std::size_t kMost = 8;
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (i != to && alike(discs[i], discs[to])) {
      near.emplace_back((discs[i].pixel - discs[to].pixel).squaredNorm(), i);
    }
  }
  const std::size_t count = std::min(kMost, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<long>(count), near.end());
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < count; ++k) {
    result.push_back(near[k].second);
  }
  return result;
}

/** A grid that grows from three discs in a corner. */
class GrowingGrid
{
public:
  GrowingGrid(const std::vector<Disc> &discs, std::size_t corner, std::size_t right,
              std::size_t down)
      : m_discs(discs), m_taken(discs.size(), false)
  {
    place({0, 0}, corner);
    place({1, 0}, right);
    place({0, 1}, down);
  }

  /** Fills the square, then adds discs beside it until there are no more, or more than `most`. */
  void grow(std::size_t most)
  {
    if (!tryBeside({1, 1})) {
      return;
    }
    for (bool grown = true; grown && m_placed.size() <= most;) {
      grown = false;
      const auto placed = m_placed;
      for (const auto &[cell, disc] : placed) {
        for (const Cell &way : kWays) {
          grown = tryBeside({cell.first + way.first, cell.second + way.second}) || grown;
        }
      }
    }
  }

  std::size_t size() const { return m_placed.size(); }

  std::vector<GridPoint> points() const
  {
    std::vector<GridPoint> result;
    for (const auto &[cell, disc] : m_placed) {
      result.push_back({cell.first, cell.second, m_discs[disc].pixel});
    }
    return result;
  }

private:
  using Cell = std::pair<int, int>; ///< column and row
  static constexpr std::array<Cell, 4> kWays{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

  void place(const Cell &cell, std::size_t disc)
  {
    m_placed[cell] = disc;
    m_taken[disc] = true;
  }

  const Disc *at(int column, int row) const
  {
    const auto found = m_placed.find({column, row});
    return found == m_placed.end() ? nullptr : &m_discs[found->second];
  }

  /** Where a disc of the grid is expected. */
  struct Guess
  {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double tolerance = 0.0; ///< pixels
    const Disc *beside = nullptr;
  };

  /** By what is placed, in the order of what it is worth: parallelograms and curves, lines. */
  std::optional<Guess> guess(const Cell &cell) const
  {
    constexpr double kNear = 0.2; // of the step
    constexpr double kNearLine = 0.3;
    const auto &[c, r] = cell;
    Guess good;
    Guess rough;
    int count = 0;
    const auto add = [&](const Disc &beside, const Eigen::Vector2d &step) {
      good.pixel += beside.pixel + step;
      good.tolerance = std::max(good.tolerance, kNear * step.norm());
      good.beside = &beside;
      ++count;
    };
    for (const auto &[right, down] : kWays) {
      const Disc *beside = at(c - right, r - down);
      if (beside == nullptr) {
        continue;
      }
      const Disc *second = at(c - 2 * right, r - 2 * down);
      const Disc *third = at(c - 3 * right, r - 3 * down);
      if (second != nullptr) {
        const Eigen::Vector2d step = beside->pixel - second->pixel;
        rough = {beside->pixel + step, kNearLine * step.norm(), beside};
        if (third != nullptr) {
          add(*beside, 2.0 * step - (second->pixel - third->pixel));
        }
      }
      for (const int side : {-1, 1}) {
        const Disc *far = at(c + side * down, r + side * right);
        const Disc *across = at(c - right + side * down, r - down + side * right);
        if (far != nullptr && across != nullptr) {
          add(*beside, far->pixel - across->pixel);
        }
      }
    }
    if (count > 0) {
      good.pixel /= count;
      return good;
    }
    return rough.beside != nullptr ? std::optional(rough) : std::nullopt;
  }

  bool tryBeside(const Cell &cell)
  {
    const auto expected = m_placed.count(cell) == 0 ? guess(cell) : std::nullopt;
    if (!expected) {
      return false;
    }
    double best = expected->tolerance;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < m_discs.size(); ++i) {
      const double away = (m_discs[i].pixel - expected->pixel).norm();
      if (!m_taken[i] && away < best && alike(m_discs[i], *expected->beside)) {
        best = away;
        found = i;
      }
    }
    if (found) {
      place(cell, *found);
    }
    return found.has_value();
  }

  const std::vector<Disc> &m_discs;
  std::vector<bool> m_taken;
  std::map<Cell, std::size_t> m_placed;
};

/** Whether two ways from a disc may lead to the next column and the next row. */
bool spanGrid(const Eigen::Vector2d &right, const Eigen::Vector2d &down)
{
  constexpr double kLeastSine = 0.5;
  constexpr double kSlimmest = 3.0; // how much longer one may be
  const double turn = right.x() * down.y() - right.y() * down.x();
  return turn > kLeastSine * right.norm() * down.norm() && right.norm() < kSlimmest * down.norm() &&
         down.norm() < kSlimmest * right.norm();
}

/** The largest part of the board that grows from one disc. */
std::vector<GridPoint> gridFrom(const std::vector<Disc> &discs, std::size_t seed,
                                const GridSize &size)
{
  const auto count = size.points();
  const std::vector<std::size_t> near = nearest(discs, seed);
  std::vector<GridPoint> largest;
  for (const std::size_t right : near) {
    for (const std::size_t down : near) {
      if (!spanGrid(discs[right].pixel - discs[seed].pixel,
                    discs[down].pixel - discs[seed].pixel)) {
        continue;
      }
      GrowingGrid growing(discs, seed, right, down);
      growing.grow(2 * count);
      if (growing.size() > largest.size()) {
        std::vector<GridPoint> grid = fitted(growing.points(), size);
        if (grid.size() > largest.size()) {
          largest = std::move(grid);
        }
      }
    }
  }
  return largest;
}

} // namespace

std::vector<GridPoint> findDiscGrid(const cv::Mat1b &picture, const GridSize &size)
{
  const std::vector<Disc> discs = findDiscs(picture);
  const auto count = size.points();
  std::vector<GridPoint> largest;
  // Every disc has its try: diagonals span a grid too, but clipped to the board a smaller one.
  for (std::size_t seed = 0; seed < discs.size() && largest.size() < count; ++seed) {
    std::vector<GridPoint> grid = gridFrom(discs, seed, size);
    if (grid.size() > largest.size()) {
      largest = std::move(grid);
    }
  }
  return largest;
}

} // namespace homeward
