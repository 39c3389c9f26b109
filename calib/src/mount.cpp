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

/**
 * Landmarks where their sights cross, for a camera in the robot's middle with this yaw. What was
 * seen on the spot alone crosses in the camera itself: a weak belief puts it some metres away.
 */
Unknowns crossed(const std::vector<Sight> &sights, int landmarks, double yaw)
{
  constexpr double kUsual = 3.0;    // metres
  constexpr double kBelief = 0.002; // of a sight
  const auto count = static_cast<std::size_t>(landmarks);
  std::vector<Eigen::Matrix2d> A(count, Eigen::Matrix2d::Zero());
  std::vector<Eigen::Vector2d> b(count, Eigen::Vector2d::Zero());
  for (const Sight &sight : sights) {
    const double angle = sight.bearing + sight.oMr.heading + yaw;
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d normal(-along.y(), along.x());
    const Eigen::Vector2d eye = sight.oMr.translation();
    const auto i = static_cast<std::size_t>(sight.landmark);
    A[i] += normal * normal.transpose() + kBelief * Eigen::Matrix2d::Identity();
    b[i] += normal * normal.dot(eye) + kBelief * (eye + kUsual * along);
  }
  Unknowns x = Unknowns::Zero(kMount + 2 * landmarks);
  x[2] = yaw;
  for (std::size_t i = 0; i < count; ++i) {
    x.segment<2>(kMount + 2 * static_cast<Eigen::Index>(i)) = A[i].inverse() * b[i];
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
  constexpr double kFinest = 5e-4; // radians; below it, what was sharpest would rule alone
  return std::max(kMad * *middle, kFinest);
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

/** Normal equations of the mount and of landmarks, which meet only in the mount. */
struct NormalEquations
{
  /** One landmark's part. */
  struct Landmark
  {
    Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 3, 2> withMount = Eigen::Matrix<double, 3, 2>::Zero();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  };

  Eigen::Matrix3d mount = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  std::vector<Landmark> landmarks;

  NormalEquations(const std::vector<Sight> &sights, const Unknowns &x, double scale)
      : landmarks(static_cast<std::size_t>((x.size() - kMount) / 2))
  {
    Eigen::Matrix<double, 1, 5> J;
    for (const Sight &sight : sights) {
      const double error = residual(sight, x, &J);
      const double weight = weightOf(error, scale);
      const auto Jm = J.head<3>();
      const auto Jl = J.tail<2>();
      Landmark &landmark = landmarks[static_cast<std::size_t>(sight.landmark)];
      mount += weight * Jm.transpose() * Jm;
      gradient += weight * error * Jm.transpose();
      landmark.own += weight * Jl.transpose() * Jl;
      landmark.withMount += weight * Jm.transpose() * Jl;
      landmark.gradient += weight * error * Jl.transpose();
    }
  }

  /** Every diagonal element grows by its share, as Marquardt has it. */
  void damp(double share)
  {
    constexpr double kLeast = 1e-12;
    mount.diagonal() *= 1.0 + share;
    mount.diagonal().array() += kLeast;
    for (Landmark &landmark : landmarks) {
      landmark.own.diagonal() *= 1.0 + share;
      landmark.own.diagonal().array() += kLeast;
    }
  }

  /** What is left for the mount when every landmark follows it (Schur's complement). */
  Eigen::Matrix3d reduced() const
  {
    Eigen::Matrix3d S = mount;
    for (const Landmark &landmark : landmarks) {
      S -= landmark.withMount * landmark.own.inverse() * landmark.withMount.transpose();
    }
    return S;
  }

  Unknowns solve() const
  {
    Eigen::Vector3d right = gradient;
    for (const Landmark &landmark : landmarks) {
      right -= landmark.withMount * landmark.own.inverse() * landmark.gradient;
    }
    Unknowns step(kMount + 2 * static_cast<Eigen::Index>(landmarks.size()));
    step.head<3>() = reduced().ldlt().solve(right);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Landmark &landmark = landmarks[i];
      step.segment<2>(kMount + 2 * static_cast<Eigen::Index>(i)) =
          landmark.own.inverse() *
          (landmark.gradient - landmark.withMount.transpose() * step.head<3>());
    }
    return step;
  }
};

Unknowns refined(const std::vector<Sight> &sights, Unknowns x, int steps)
{
  double damping = 1e-3;
  for (int i = 0; i < steps; ++i) {
    const double scale = scaleOf(sights, x);
    const double cost = costOf(sights, x, scale);
    NormalEquations equations(sights, x, scale);
    equations.damp(damping);
    const Unknowns next = x + equations.solve();
    if (next.allFinite() && costOf(sights, next, scale) <= cost) {
      const bool rests = (next - x).norm() < 1e-9;
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
  constexpr int kYaws = 24;
  constexpr int kFirstSteps = 4;
  constexpr int kLastSteps = 60;
  constexpr std::size_t kFollowed = 3;
  std::vector<std::pair<double, Unknowns>> starts;
  for (int i = 0; i < kYaws; ++i) {
    const Unknowns x = refined(
        sights, crossed(sights, estimate.landmarks, 2.0 * kPi * i / kYaws - kPi), kFirstSteps);
    starts.emplace_back(scaleOf(sights, x), x);
  }
  std::sort(starts.begin(), starts.end(),
            [](const auto &a, const auto &b) { return a.first < b.first; });
  Unknowns best;
  double scale = 0.0;
  for (std::size_t i = 0; i < kFollowed; ++i) {
    const Unknowns x = refined(sights, starts[i].second, kLastSteps);
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
  NormalEquations equations(sights, best, scale);
  equations.damp(0.0);
  const double spare = std::max(static_cast<double>(sights.size()) - double(best.size()), 1.0);
  estimate.covariance = equations.reduced().inverse() * weighted / spare;
  estimate.rms = std::sqrt(sum / static_cast<double>(sights.size()));
  estimate.rMp = {best[0], best[1], wrapAngle(best[2])};
  if (!estimate.covariance.allFinite() || (estimate.covariance.diagonal().array() < 0.0).any()) {
    throw ConfigError("the drive leaves the camera's place on the robot open; turn on the spot, "
                      "then drive a metre straight, with things near by in sight");
  }
  return estimate;
}

} // namespace homeward
