// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/row_trials.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/evaluation/localization_run.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

constexpr std::uint32_t kRowStream = 402;

/** Poses on a line, heading along it. @param offset metres to the left of it */
std::vector<Pose2> line(const Pose2 &start, std::size_t count, double spacing, double offset)
{
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < count; ++i) {
    poses.push_back(start * Pose2{spacing * static_cast<double>(i), offset, 0.0});
  }
  return poses;
}

bool allReachable(const FreeSpace &space, const std::vector<Pose2> &poses)
{
  return std::all_of(poses.begin(), poses.end(),
                     [&](const Pose2 &pose) { return space.reachable(pose.translation()); });
}

/** The rows on one side of a drive. @param side 1 for its left, -1 for its right */
RowPoses rowsBeside(const FreeSpace &space, const Pose2 &start, const RowOptions &options,
                    double side)
{
  RowPoses rows{line(start, options.seen, options.seenSpacing, 0.0), {}};
  for (const double distance : options.distances) {
    std::vector<Pose2> row = line(start, options.known, options.knownSpacing, side * distance);
    const bool all = allReachable(space, row);
    rows.known.push_back(all ? std::move(row) : std::vector<Pose2>{});
  }
  return rows;
}

std::ptrdiff_t rowCount(const RowPoses &rows)
{
  return std::count_if(rows.known.begin(), rows.known.end(),
                       [](const std::vector<Pose2> &row) { return !row.empty(); });
}

} // namespace

std::vector<RowPoses> placeRows(const FreeSpace &space, std::size_t count, std::uint64_t seed,
                                const RowOptions &options)
{
  constexpr std::size_t kDraws = 20'000; // a drive
  const std::vector<Eigen::Vector2d> &cells = space.reachableCells();
  if (cells.empty()) {
    throw LogicError("no floor of this world can be reached");
  }
  Random random(seed, kRowStream);
  std::vector<RowPoses> found;
  for (std::size_t draw = 0; draw < kDraws * count && found.size() < count; ++draw) {
    const double share = random.uniform(0.0, static_cast<double>(cells.size()));
    const Eigen::Vector2d cell = cells[std::min(cells.size() - 1, static_cast<std::size_t>(share))];
    const Pose2 start{cell.x(), cell.y(), random.uniform(-kPi, kPi)};
    if (allReachable(space, line(start, options.seen, options.seenSpacing, 0.0))) {
      RowPoses left = rowsBeside(space, start, options, 1.0);
      RowPoses right = rowsBeside(space, start, options, -1.0);
      found.push_back(rowCount(left) >= rowCount(right) ? std::move(left) : std::move(right));
    }
  }
  return found;
}

double rowSuccess(const std::vector<Pose2> &knownPoses, const std::vector<Signature> &known,
                  const std::vector<Pose2> &seenPoses, const std::vector<Signature> &seen,
                  const BayesOptions &options)
{
  KnownPlaces places;
  for (std::size_t i = 0; i < knownPoses.size(); ++i) {
    places.nodes.push_back(NodeId{static_cast<std::int64_t>(i)});
  }
  places.signatures = known;
  places.steps = stepsBetween(knownPoses);
  const std::vector<Localization> found = localize(places, seen, std::nullopt, options);
  std::size_t right = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto answer = static_cast<std::size_t>(found[i].node.value);
    right += answer == nearestPlace(knownPoses, seenPoses[i]) ? 1U : 0U;
  }
  return found.empty() ? 0.0 : static_cast<double>(right) / static_cast<double>(found.size());
}

} // namespace homeward
