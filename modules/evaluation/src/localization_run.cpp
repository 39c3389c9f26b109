// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/localization_run.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{

namespace
{

double between(const Pose2 &a, const Pose2 &b)
{
  return (a.translation() - b.translation()).norm();
}

/** Median distance of a place to its nearest neighbour elsewhere; 1 without one. */
double neighbourDistance(const std::vector<Pose2> &places)
{
  std::vector<double> nearest;
  for (const Pose2 &place : places) {
    double least = std::numeric_limits<double>::infinity();
    for (const Pose2 &other : places) {
      const double distance = between(place, other);
      least = distance > 0.0 ? std::min(least, distance) : least;
    }
    nearest.push_back(least);
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return middle != nearest.end() && std::isfinite(*middle) ? *middle : 1.0;
}

} // namespace

Eigen::MatrixXd stepsBetween(const std::vector<Pose2> &places)
{
  const double step = neighbourDistance(places);
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd steps(count, count);
  for (Eigen::Index to = 0; to < count; ++to) {
    for (Eigen::Index from = 0; from < count; ++from) {
      steps(to, from) = std::round(
          between(places[static_cast<std::size_t>(to)], places[static_cast<std::size_t>(from)]) /
          step);
    }
  }
  return steps;
}

std::size_t nearestPlace(const std::vector<Pose2> &places, const Pose2 &pose)
{
  if (places.empty()) {
    throw LogicError("there is no place to be near to");
  }
  const auto nearest =
      std::min_element(places.begin(), places.end(), [&](const Pose2 &a, const Pose2 &b) {
        return between(a, pose) < between(b, pose);
      });
  return static_cast<std::size_t>(nearest - places.begin());
}

std::vector<Localization> localize(const KnownPlaces &known, const std::vector<Signature> &seen,
                                   std::optional<NodeId> start, const BayesOptions &options)
{
  BayesLocalizer localizer(known.nodes, start, options);
  std::vector<Localization> found;
  for (const Signature &view : seen) {
    if (!found.empty()) {
      localizer.move(known.steps);
    }
    std::vector<double> dissimilarities;
    for (const Signature &signature : known.signatures) {
      dissimilarities.push_back(dissimilarity(view, signature));
    }
    localizer.observe(dissimilarities);
    found.push_back({localizer.mostProbable(),
                     *std::max_element(localizer.belief().begin(), localizer.belief().end()),
                     localizer.kidnapped(), localizer.belief()});
  }
  return found;
}

} // namespace homeward
