// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/mount.h>

#include "mount_fit.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace homeward
{
namespace
{

std::string rounded(double value)
{
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

std::vector<Sight> sightsOf(const std::vector<MountSample> &drive, int &landmarks)
{
  constexpr int kFewestSights = 3;
  std::map<int, int> counts;
  for (const MountSample &sample : drive) {
    for (const LandmarkBearing &seen : sample.bearings) {
      ++counts[seen.landmark];
    }
  }
  constexpr std::size_t kMost = 250; // those seen most often
  std::vector<std::pair<int, int>> often;
  for (const auto &[id, count] : counts) {
    if (count >= kFewestSights) {
      often.emplace_back(-count, id);
    }
  }
  std::sort(often.begin(), often.end());
  often.resize(std::min(often.size(), kMost));
  std::map<int, Eigen::Index> index;
  for (const auto &[count, id] : often) {
    index.emplace(id, static_cast<Eigen::Index>(index.size()));
  }
  std::vector<Sight> sights;
  for (std::size_t place = 0; place < drive.size(); ++place) {
    for (const LandmarkBearing &seen : drive[place].bearings) {
      const auto found = index.find(seen.landmark);
      if (found != index.end()) {
        sights.push_back({place, found->second, seen.bearing});
      }
    }
  }
  landmarks = static_cast<int>(index.size());
  return sights;
}

/** From how many places a landmark is seen, on average. */
double meanSights(const std::vector<MountSample> &drive)
{
  std::set<int> landmarks;
  std::size_t sights = 0;
  for (const MountSample &sample : drive) {
    for (const LandmarkBearing &seen : sample.bearings) {
      landmarks.insert(seen.landmark);
      ++sights;
    }
  }
  return static_cast<double>(sights) /
         static_cast<double>(std::max<std::size_t>(1, landmarks.size()));
}

void checkDrive(const std::vector<MountSample> &drive, int landmarks)
{
  constexpr double kShortest = 0.5;  // metres
  constexpr double kLongest = 20.0;  // metres
  constexpr double kSharpest = 60.0; // degrees
  constexpr double kLeast = 90.0;    // degrees
  constexpr int kFewest = 25;
  double way = 0.0;
  double turn = 0.0;
  for (const MountSample &a : drive) {
    for (const MountSample &b : drive) {
      way = std::max(way, (a.oMr.translation() - b.oMr.translation()).norm());
      turn = std::max(turn, std::abs(wrapAngle(a.oMr.heading - b.oMr.heading)));
    }
  }
  if (way < kShortest) {
    throw ConfigError("the robot drove " + rounded(way) +
                      " m; the camera's yaw shows only on a straight line of 0.5 m or more");
  }
  for (std::size_t i = 1; i < drive.size(); ++i) {
    const double step = degrees(wrapAngle(drive[i].oMr.heading - drive[i - 1].oMr.heading));
    if (std::abs(step) > kSharpest) {
      throw ConfigError("the robot turned " + rounded(step) + " degrees from picture " +
                        std::to_string(i - 1) +
                        " to the next, which none can follow; are its headings in radians?");
    }
  }
  if (way > kLongest) {
    throw ConfigError("the robot drove " + rounded(way) +
                      " m, which is no short drive; are its poses in metres?");
  }
  if (degrees(turn) < kLeast) {
    throw ConfigError("the robot turned " + rounded(degrees(turn)) +
                      " degrees; the camera's offset shows only in a turn of 90 or more");
  }
  if (landmarks < kFewest) {
    throw ConfigError(std::to_string(landmarks) +
                      " landmarks were seen from three places or more, at least " +
                      std::to_string(kFewest) + " are needed; drive where there is more to see");
  }
  constexpr double kFollowed = 0.15; // of the pictures; what is lost at once drifts before
  const double followed = meanSights(drive);
  if (followed < kFollowed * static_cast<double>(drive.size())) {
    throw ConfigError("landmarks are lost again after " + rounded(followed) + " of " +
                      std::to_string(drive.size()) +
                      " pictures, as in a bare room; drive where there is more to see");
  }
}

/** A landmark and in which direction it stands. */
struct Direction
{
  double angle; ///< from the drive's start, radians
  std::size_t landmark;
};

/** All landmarks, by their angles. */
std::vector<Direction> directionsOf(const Seen &seen, const Unknowns &x)
{
  const Eigen::Index own = seen.way.own();
  const Eigen::Vector2d middle = seen.way.places(x).front().translation();
  std::vector<Direction> directions;
  for (Eigen::Index i = own; i < x.size(); i += 2) {
    const Eigen::Vector2d away = x.segment<2>(i) - middle;
    directions.push_back({std::atan2(away.y(), away.x()), directions.size()});
  }
  std::sort(directions.begin(), directions.end(),
            [](const Direction &a, const Direction &b) { return a.angle < b.angle; });
  return directions;
}

/** What stands abeam of a straight line shows its direction; what lies ahead hardly does. */
void checkAllRound(const std::vector<Direction> &directions)
{
  double widest = 2.0 * kPi + directions.front().angle - directions.back().angle;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    widest = std::max(widest, directions[i].angle - directions[i - 1].angle);
  }
  if (widest > kPi) {
    throw ConfigError("the " + std::to_string(directions.size()) +
                      " landmarks seen often enough stand on one side of the robot, within " +
                      std::to_string(std::lround(360.0 - degrees(widest))) +
                      " degrees; drive where there are things on all sides");
  }
}

/**
 * The mount's covariance, each number's sigma grown to what leaving neighbours out together shows
 * (the jackknife): sights of one landmark, and of landmarks side by side, err alike. \cite
 * Efron1982
 */
Eigen::Matrix3d widened(const Eigen::Matrix3d &covariance, const Seen &seen, const Unknowns &best,
                        const std::vector<Direction> &directions)
{
  constexpr int kGroups = 8;
  constexpr int kSteps = 20;
  std::vector<int> group(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    group[directions[i].landmark] =
        static_cast<int>(i * static_cast<std::size_t>(kGroups) / directions.size());
  }
  std::vector<Eigen::Vector3d> mounts;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int out = 0; out < kGroups; ++out) {
    Seen rest{seen.way, {}};
    std::copy_if(
        seen.sights.begin(), seen.sights.end(), std::back_inserter(rest.sights),
        [&](const Sight &sight) { return group[static_cast<std::size_t>(sight.landmark)] != out; });
    const Unknowns x = refined(rest, best, kSteps);
    mounts.emplace_back(x[0], x[1], best[2] + wrapAngle(x[2] - best[2]));
    mean += mounts.back() / kGroups;
  }
  Eigen::Array3d variance = Eigen::Array3d::Zero();
  for (const Eigen::Vector3d &mount : mounts) {
    variance += (kGroups - 1.0) / kGroups * (mount - mean).array().square();
  }
  const Eigen::Array3d factor = (variance / covariance.diagonal().array()).max(1.0).sqrt();
  return factor.matrix().asDiagonal() * covariance * factor.matrix().asDiagonal();
}

/** @param scale of the bearings' errors but for a few, radians */
void checkEstimate(const MountEstimate &estimate, double scale)
{
  constexpr double kYaw = radians(1.5);
  constexpr double kOffset = 0.03;  // metres
  constexpr double kFarthest = 1.0; // metres
  constexpr double kRough = radians(1.0);
  const Eigen::Matrix3d &covariance = estimate.covariance;
  if (!covariance.allFinite() || (covariance.diagonal().array() < 0.0).any()) {
    throw ConfigError(
        "the drive leaves the camera's place on the robot open; turn on the spot, then "
        "drive a metre straight, with things near by in sight on all sides");
  }
  const double yaw = std::sqrt(covariance(2, 2));
  const double offset = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  if (yaw > kYaw || offset > kOffset) {
    throw ConfigError("the drive tells the camera's yaw to no better than " +
                      rounded(degrees(yaw)) + " degrees and its place to " + rounded(offset) +
                      " m; turn on the spot, then drive a metre straight, with things near by in "
                      "sight on all sides");
  }
  const double away = estimate.rMp.translation().norm();
  if (away > kFarthest || scale > kRough) {
    throw ConfigError("the pictures do not fit the odometry: the camera would sit " +
                      rounded(away) + " m from the robot's middle, bearings off by " +
                      rounded(degrees(scale)) +
                      " degrees; is each picture of the pose beside it, in metres and radians?");
  }
}

} // namespace

MountEstimate calibrateMount(const std::vector<MountSample> &drive)
{
  MountEstimate estimate;
  const Seen seen{Way(drive), sightsOf(drive, estimate.landmarks)};
  checkDrive(drive, estimate.landmarks);
  // The starts whose sights cross best are followed, first a few steps, then to their end.
  constexpr int kYaws = 24;
  constexpr int kSlips = 6; // either way
  constexpr double kSlip = 0.02;
  constexpr int kFirstSteps = 8;
  constexpr int kLastSteps = 150;
  constexpr std::size_t kTried = 8;
  constexpr std::size_t kFollowed = 2;
  std::vector<std::pair<double, Unknowns>> starts;
  const auto sortStarts = [&](std::size_t kept) {
    std::sort(starts.begin(), starts.end(),
              [](const auto &a, const auto &b) { return a.first < b.first; });
    starts.resize(kept);
  };
  for (int i = 0; i < kYaws; ++i) {
    for (int k = -kSlips; k <= kSlips; ++k) {
      const Unknowns start = seen.way.start(2.0 * kPi * i / kYaws - kPi, kSlip * k);
      const Unknowns x = crossed(seen, estimate.landmarks, start);
      starts.emplace_back(scaleOf(seen, x), x);
    }
  }
  sortStarts(kTried);
  for (auto &[scale, x] : starts) {
    x = refined(seen, x, kFirstSteps);
    scale = scaleOf(seen, x);
  }
  sortStarts(kFollowed);
  Unknowns best;
  double scale = 0.0;
  for (std::size_t i = 0; i < kFollowed; ++i) {
    const Unknowns x = refined(seen, starts[i].second, kLastSteps);
    const double here = scaleOf(seen, x);
    if (best.size() == 0 || here < scale) {
      best = x;
      scale = here;
    }
  }
  const MountSpread spread = spreadOf(seen, best, scale);
  estimate.covariance = spread.covariance;
  estimate.rms = spread.rms;
  estimate.rMp = {best[0], best[1], wrapAngle(best[2])};
  const std::vector<Direction> directions = directionsOf(seen, best);
  checkAllRound(directions);
  estimate.covariance = widened(estimate.covariance, seen, best, directions);
  checkEstimate(estimate, scale);
  return estimate;
}

} // namespace homeward
