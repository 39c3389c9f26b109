// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/mount.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace homeward
{
namespace
{

/** One bearing, with landmarks counted from 0. */
struct Sight
{
  Pose2 oMr;
  Eigen::Index landmark;
  double bearing;
};

/** Mount (x, y, heading) and landmarks, one after the other. */
using Unknowns = Eigen::VectorXd;

constexpr Eigen::Index kMount = 3;

std::vector<Sight> sightsOf(const std::vector<MountSample> &drive, int &landmarks)
{
  constexpr int kFewestSights = 3;
  std::map<int, int> counts;
  for (const MountSample &sample : drive) {
    for (const LandmarkBearing &seen : sample.bearings) {
      ++counts[seen.landmark];
    }
  }
  std::map<int, Eigen::Index> index;
  for (const auto &[id, count] : counts) {
    if (count >= kFewestSights) {
      index.emplace(id, static_cast<Eigen::Index>(index.size()));
    }
  }
  std::vector<Sight> sights;
  for (const MountSample &sample : drive) {
    for (const LandmarkBearing &seen : sample.bearings) {
      const auto found = index.find(seen.landmark);
      if (found != index.end()) {
        sights.push_back({sample.oMr, found->second, seen.bearing});
      }
    }
  }
  landmarks = static_cast<int>(index.size());
  return sights;
}

void checkDrive(const std::vector<MountSample> &drive, int landmarks)
{
  constexpr double kShortest = 0.5; // metres
  constexpr double kLeast = 90.0;   // degrees
  constexpr int kFewest = 3;
  double way = 0.0;
  double turn = 0.0;
  for (const MountSample &a : drive) {
    for (const MountSample &b : drive) {
      way = std::max(way, (a.oMr.translation() - b.oMr.translation()).norm());
      turn = std::max(turn, std::abs(wrapAngle(a.oMr.heading - b.oMr.heading)));
    }
  }
  if (way < kShortest) {
    throw ConfigError("the robot drove " + std::to_string(way) +
                      " m; the camera's yaw shows only on a straight line of 0.5 m or more");
  }
  if (degrees(turn) < kLeast) {
    throw ConfigError("the robot turned " + std::to_string(degrees(turn)) +
                      " degrees; the camera's offset shows only in a turn of 90 or more");
  }
  if (landmarks < kFewest) {
    throw ConfigError(std::to_string(landmarks) +
                      " landmarks were seen from three places or more; drive where at least "
                      "three stay in sight");
  }
}

/** Seen minus predicted, and the gradient of the prediction. */
double residual(const Sight &sight, const Unknowns &x, Eigen::Matrix<double, 1, 5> *J = nullptr)
{
  const double heading = sight.oMr.heading;
  const Eigen::Vector2d eye = sight.oMr * Eigen::Vector2d(x.head<2>());
  const Eigen::Vector2d away = x.segment<2>(kMount + 2 * sight.landmark) - eye;
  const double length2 = std::max(away.squaredNorm(), 1e-12);
  if (J != nullptr) {
    const Eigen::RowVector2d across = Eigen::RowVector2d(-away.y(), away.x()) / length2;
    Eigen::Matrix2d R;
    R << std::cos(heading), -std::sin(heading), std::sin(heading), std::cos(heading);
    *J << -across * R, -1.0, across;
  }
  return wrapAngle(sight.bearing - std::atan2(away.y(), away.x()) + heading + x[2]);
}

/** Landmarks where their sights cross, for a camera in the robot's middle with this yaw. */
Unknowns crossed(const std::vector<Sight> &sights, int landmarks, double yaw)
{
  Unknowns x = Unknowns::Zero(kMount + 2 * landmarks);
  x[2] = yaw;
  for (int i = 0; i < landmarks; ++i) {
    Eigen::Matrix2d A = 1e-6 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (const Sight &sight : sights) {
      if (sight.landmark == i) {
        const double angle = sight.bearing + sight.oMr.heading + yaw;
        const Eigen::Vector2d normal(-std::sin(angle), std::cos(angle));
        A += normal * normal.transpose();
        b += normal * normal.dot(sight.oMr.translation());
      }
    }
    x.segment<2>(kMount + 2 * i) = A.inverse() * b;
  }
  return x;
}

double weightOf(double error, double scale)
{
  constexpr double kHuber = 2.0;
  return std::abs(error) <= kHuber * scale ? 1.0 : kHuber * scale / std::abs(error);
}

double scaleOf(const std::vector<Sight> &sights, const Unknowns &x)
{
  std::vector<double> errors;
  for (const Sight &sight : sights) {
    errors.push_back(std::abs(residual(sight, x)));
  }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  constexpr double kMad = 1.4826;
  return std::max(kMad * *middle, 1e-6);
}

double costOf(const std::vector<Sight> &sights, const Unknowns &x, double scale)
{
  constexpr double kHuber = 2.0;
  double sum = 0.0;
  for (const Sight &sight : sights) {
    const double s = std::abs(residual(sight, x)) / scale;
    sum += s <= kHuber ? s * s : 2.0 * kHuber * s - kHuber * kHuber;
  }
  return sum;
}

Eigen::MatrixXd normalMatrix(const std::vector<Sight> &sights, const Unknowns &x, double scale,
                             Eigen::VectorXd &g)
{
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(x.size(), x.size());
  g.setZero(x.size());
  Eigen::Matrix<double, 1, 5> J;
  for (const Sight &sight : sights) {
    const double error = residual(sight, x, &J);
    const double weight = weightOf(error, scale);
    const Eigen::Index at = kMount + 2 * sight.landmark;
    const Eigen::Index columns[] = {0, 1, 2, at, at + 1};
    for (int i = 0; i < 5; ++i) {
      g[columns[i]] += weight * J[i] * error;
      for (int k = 0; k < 5; ++k) {
        H(columns[i], columns[k]) += weight * J[i] * J[k];
      }
    }
  }
  return H;
}

Unknowns refined(const std::vector<Sight> &sights, Unknowns x)
{
  constexpr int kIterations = 60;
  double damping = 1e-3;
  Eigen::VectorXd g;
  for (int i = 0; i < kIterations; ++i) {
    const double scale = scaleOf(sights, x);
    const double cost = costOf(sights, x, scale);
    Eigen::MatrixXd H = normalMatrix(sights, x, scale, g);
    H.diagonal() *= 1.0 + damping;
    H.diagonal().array() += 1e-12;
    const Unknowns next = x + H.ldlt().solve(g);
    if (next.allFinite() && costOf(sights, next, scale) <= cost) {
      const bool rests = (next - x).norm() < 1e-12;
      x = next;
      damping = std::max(0.1 * damping, 1e-12);
      if (rests) {
        break;
      }
    }
    else {
      damping *= 10.0;
    }
  }
  return x;
}

} // namespace

MountEstimate calibrateMount(const std::vector<MountSample> &drive)
{
  MountEstimate estimate;
  const std::vector<Sight> sights = sightsOf(drive, estimate.landmarks);
  checkDrive(drive, estimate.landmarks);
  // The starts in whose middle the sights cross best are followed.
  constexpr int kYaws = 12;
  constexpr std::size_t kFollowed = 2;
  std::vector<std::pair<double, Unknowns>> starts;
  for (int i = 0; i < kYaws; ++i) {
    const Unknowns x = crossed(sights, estimate.landmarks, 2.0 * kPi * i / kYaws - kPi);
    starts.emplace_back(scaleOf(sights, x), x);
  }
  std::sort(starts.begin(), starts.end(),
            [](const auto &a, const auto &b) { return a.first < b.first; });
  Unknowns best;
  double scale = 0.0;
  for (std::size_t i = 0; i < kFollowed; ++i) {
    const Unknowns x = refined(sights, starts[i].second);
    const double here = scaleOf(sights, x);
    if (best.size() == 0 || here < scale) {
      best = x;
      scale = here;
    }
  }
  double sum = 0.0;
  double weighted = 0.0;
  for (const Sight &sight : sights) {
    const double error = residual(sight, best);
    sum += error * error;
    weighted += weightOf(error, scale) * error * error;
  }
  Eigen::VectorXd g;
  const Eigen::MatrixXd H = normalMatrix(sights, best, scale, g);
  const double spare = std::max(static_cast<double>(sights.size()) - double(best.size()), 1.0);
  const Eigen::MatrixXd inverse =
      H.ldlt().solve(Eigen::MatrixXd::Identity(best.size(), best.size()));
  estimate.covariance = inverse.topLeftCorner<3, 3>() * weighted / spare;
  estimate.rms = std::sqrt(sum / static_cast<double>(sights.size()));
  estimate.rMp = {best[0], best[1], wrapAngle(best[2])};
  if (!estimate.covariance.allFinite() || (estimate.covariance.diagonal().array() < 0.0).any()) {
    throw ConfigError("the drive leaves the camera's place on the robot open; turn on the spot, "
                      "then drive a metre straight, with things near by in sight");
  }
  return estimate;
}

} // namespace homeward
