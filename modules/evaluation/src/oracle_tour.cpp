// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/oracle_tour.h>

#include <homeward/core/error.h>
#include <homeward/evaluation/coverage.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace homeward
{
namespace
{

constexpr double kPlaceSpacing = 0.5;  // metres
constexpr double kSampleSpacing = 0.2; // metres
constexpr double kEnough = 0.99;       // share of what can be covered

using Points = std::vector<Eigen::Vector2d>;

/** Of each square, the cell nearest to its middle. */
Points thinned(const Points &cells, double spacing)
{
  const auto offCentre = [&](const Eigen::Vector2d &cell, const std::pair<int, int> &square) {
    const Eigen::Vector2d centre(square.first + 0.5, square.second + 0.5);
    return (cell - spacing * centre).squaredNorm();
  };
  std::map<std::pair<int, int>, Eigen::Vector2d> best;
  for (const Eigen::Vector2d &cell : cells) {
    const std::pair square{static_cast<int>(std::floor(cell.x() / spacing)),
                           static_cast<int>(std::floor(cell.y() / spacing))};
    const auto [known, isNew] = best.try_emplace(square, cell);
    if (!isNew && offCentre(cell, square) < offCentre(known->second, square)) {
      known->second = cell;
    }
  }
  Points points;
  for (const auto &[square, cell] : best) {
    points.push_back(cell);
  }
  return points;
}

/** For each place the indices of the samples that it covers. */
std::vector<std::vector<std::size_t>> coveredBy(const FreeSpace &space, const Points &places,
                                                const Points &samples, double reach)
{
  std::vector<std::vector<std::size_t>> covered(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < samples.size(); ++j) {
      if ((places[i] - samples[j]).norm() <= reach && space.sees(places[i], samples[j])) {
        covered[i].push_back(j);
      }
    }
  }
  return covered;
}

/** The first of `places` and as few others as it takes, chosen greedily. */
Points coveringPlaces(const FreeSpace &space, const Points &places, const Points &samples,
                      double reach)
{
  const std::vector<std::vector<std::size_t>> covered = coveredBy(space, places, samples, reach);
  std::vector<bool> canBe(samples.size(), false);
  for (const std::vector<std::size_t> &some : covered) {
    for (const std::size_t sample : some) {
      canBe[sample] = true;
    }
  }
  const auto all = static_cast<double>(std::count(canBe.begin(), canBe.end(), true));
  std::vector<bool> done(samples.size(), false);
  double count = 0.0;
  const auto gain = [&](std::size_t place) {
    return std::count_if(covered[place].begin(), covered[place].end(),
                         [&](std::size_t sample) { return !done[sample]; });
  };
  Points chosen;
  std::size_t next = 0;
  while (true) {
    count += static_cast<double>(gain(next));
    chosen.push_back(places[next]);
    for (const std::size_t sample : covered[next]) {
      done[sample] = true;
    }
    if (count >= kEnough * all) {
      return chosen;
    }
    std::ptrdiff_t most = 0;
    for (std::size_t place = 0; place < places.size(); ++place) {
      const std::ptrdiff_t more = gain(place);
      if (more > most) {
        most = more;
        next = place;
      }
    }
  }
}

Eigen::MatrixXd wayLengths(const FreeSpace &space, const Points &places)
{
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd lengths = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = i + 1; j < count; ++j) {
      const std::optional<double> length =
          space.pathLength(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(j)],
                           std::numeric_limits<double>::max());
      if (!length) {
        throw LogicError("no way between two places of one region");
      }
      lengths(i, j) = lengths(j, i) = *length;
    }
  }
  return lengths;
}

std::vector<int> nearestNeighbours(const Eigen::MatrixXd &lengths)
{
  std::vector<int> order(static_cast<std::size_t>(lengths.rows()));
  std::iota(order.begin(), order.end(), 0);
  for (auto here = order.begin(); here != order.end() && here + 1 != order.end(); ++here) {
    std::iter_swap(here + 1, std::min_element(here + 1, order.end(), [&](int a, int b) {
                     return lengths(*here, a) < lengths(*here, b);
                   }));
  }
  return order;
}

/** Turns round the part from `first` to `last` if that is shorter. */
bool turnRound(std::vector<int> &order, const Eigen::MatrixXd &lengths, std::size_t first,
               std::size_t last)
{
  constexpr double kShorter = 1e-9;
  double change = lengths(order[first - 1], order[last]) - lengths(order[first - 1], order[first]);
  if (last + 1 < order.size()) {
    change += lengths(order[first], order[last + 1]) - lengths(order[last], order[last + 1]);
  }
  if (change >= -kShorter) {
    return false;
  }
  std::reverse(order.begin() + static_cast<std::ptrdiff_t>(first),
               order.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  return true;
}

} // namespace

std::vector<int> shortOpenTour(const Eigen::MatrixXd &lengths)
{
  std::vector<int> order = nearestNeighbours(lengths);
  bool shorter = true;
  while (shorter) {
    shorter = false;
    for (std::size_t first = 1; first < order.size(); ++first) {
      for (std::size_t last = first + 1; last < order.size(); ++last) {
        shorter = turnRound(order, lengths, first, last) || shorter;
      }
    }
  }
  return order;
}

OracleTour oracleTour(const FreeSpace &space, const Eigen::Vector2d &start, double reach)
{
  const Points cells = space.reachableCells(start);
  if (cells.empty()) {
    throw LogicError("the robot does not fit where the tour is to start");
  }
  Points places{start};
  for (const Eigen::Vector2d &place : thinned(cells, kPlaceSpacing)) {
    places.push_back(place);
  }
  places = coveringPlaces(space, places, thinned(cells, kSampleSpacing), reach);
  const Eigen::MatrixXd lengths = wayLengths(space, places);
  const std::vector<int> order = shortOpenTour(lengths);
  OracleTour tour;
  CoverageMeter meter(space, start, reach);
  for (std::size_t i = 0; i < order.size(); ++i) {
    tour.places.push_back(places[static_cast<std::size_t>(order[i])]);
    tour.length += i == 0 ? 0.0 : lengths(order[i - 1], order[i]);
    meter.add(tour.places.back());
  }
  tour.coverage = meter.share();
  return tour;
}

} // namespace homeward
