// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/mount.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
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
  std::size_t place; ///< of the drive
  Eigen::Index landmark;
  double bearing;
};

/** Mount (x, y, heading), how much more each step turned than odometry says, and landmarks. */
using Unknowns = Eigen::VectorXd;

constexpr Eigen::Index kMount = 3;

std::string rounded(double value)
{
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

/** The odometry of a drive as steps from place to place. */
class Way
{
public:
  explicit Way(const std::vector<MountSample> &drive)
  {
    for (std::size_t i = 0; i < drive.size(); ++i) {
      m_steps.push_back(i == 0 ? drive[0].oMr : drive[i - 1].oMr.inverse() * drive[i].oMr);
    }
  }

  /** Unknowns that come before the landmarks: the mount's and one a step. */
  Eigen::Index own() const { return kMount + static_cast<Eigen::Index>(m_steps.size()) - 1; }

  std::vector<Pose2> places(const Unknowns &x) const
  {
    std::vector<Pose2> result;
    for (const Pose2 &step : m_steps) {
      const auto i = static_cast<Eigen::Index>(result.size());
      result.push_back(
          i == 0 ? step : result.back() * Pose2{step.x, step.y, step.heading + x[kMount + i - 1]});
    }
    return result;
  }

  /** The unknowns of a camera in the robot's middle, where every turn is a share longer. */
  Unknowns start(double yaw, double slip) const
  {
    Unknowns x = Unknowns::Zero(own());
    x[2] = yaw;
    for (std::size_t i = 1; i < m_steps.size(); ++i) {
      x[kMount + static_cast<Eigen::Index>(i) - 1] = slip * m_steps[i].heading;
    }
    return x;
  }

  /** Standard deviation of what a step turns more: wheels that skid, and a little in any case. */
  double sigma(Eigen::Index step) const
  {
    constexpr double kShare = 0.1;
    constexpr double kLeast = 0.002; // radians
    return kLeast + kShare * std::abs(m_steps[static_cast<std::size_t>(step) + 1].heading);
  }

private:
  std::vector<Pose2> m_steps; ///< the first one is a place
};

/** What was seen on the way. */
struct Seen
{
  Way way;
  std::vector<Sight> sights;
};

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
}

/**
 * Seen minus predicted, and the gradient of the prediction.
 * @param J by the unknowns of the way; only those before the place are not zero
 * @param Jl by the landmark
 */
double residual(const Sight &sight, const std::vector<Pose2> &places, Eigen::Index own,
                const Unknowns &x, Eigen::RowVectorXd *J = nullptr,
                Eigen::RowVector2d *Jl = nullptr)
{
  const Pose2 &oMr = places[sight.place];
  const Eigen::Vector2d eye = oMr * Eigen::Vector2d(x.head<2>());
  const Eigen::Vector2d away = x.segment<2>(own + 2 * sight.landmark) - eye;
  if (J != nullptr) {
    *Jl = Eigen::RowVector2d(-away.y(), away.x()) / std::max(away.squaredNorm(), 1e-12);
    J->setZero(own);
    J->head<2>() = -*Jl * Eigen::Rotation2Dd(oMr.heading).toRotationMatrix();
    (*J)[2] = -1.0;
    for (std::size_t step = 1; step <= sight.place; ++step) {
      // All that comes after a step turns about where it ended.
      const Eigen::Vector2d arm = eye - places[step].translation();
      (*J)[kMount + static_cast<Eigen::Index>(step) - 1] =
          -Jl->dot(Eigen::RowVector2d(-arm.y(), arm.x())) - 1.0;
    }
  }
  return wrapAngle(sight.bearing - std::atan2(away.y(), away.x()) + oMr.heading + x[2]);
}

/**
 * The start with landmarks where their sights cross. What was seen on the spot alone crosses in the
 * camera itself: a weak belief puts it some metres away.
 */
Unknowns crossed(const Seen &seen, int landmarks, const Unknowns &start)
{
  constexpr double kUsual = 3.0;    // metres
  constexpr double kBelief = 0.002; // of a sight
  const auto count = static_cast<std::size_t>(landmarks);
  std::vector<Eigen::Matrix2d> A(count, Eigen::Matrix2d::Zero());
  std::vector<Eigen::Vector2d> b(count, Eigen::Vector2d::Zero());
  const Eigen::Index own = start.size();
  const std::vector<Pose2> places = seen.way.places(start);
  for (const Sight &sight : seen.sights) {
    const Pose2 &oMr = places[sight.place];
    const double angle = sight.bearing + oMr.heading + start[2];
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d normal(-along.y(), along.x());
    const Eigen::Vector2d eye = oMr.translation();
    const auto i = static_cast<std::size_t>(sight.landmark);
    A[i] += normal * normal.transpose() + kBelief * Eigen::Matrix2d::Identity();
    b[i] += normal * normal.dot(eye) + kBelief * (eye + kUsual * along);
  }
  Unknowns x(own + 2 * landmarks);
  x.head(own) = start;
  for (std::size_t i = 0; i < count; ++i) {
    x.segment<2>(own + 2 * static_cast<Eigen::Index>(i)) = A[i].inverse() * b[i];
  }
  return x;
}

double weightOf(double error, double scale)
{
  constexpr double kHuber = 2.0;
  return std::abs(error) <= kHuber * scale ? 1.0 : kHuber * scale / std::abs(error);
}

double scaleOf(const Seen &seen, const Unknowns &x)
{
  const std::vector<Pose2> places = seen.way.places(x);
  std::vector<double> errors;
  for (const Sight &sight : seen.sights) {
    errors.push_back(std::abs(residual(sight, places, seen.way.own(), x)));
  }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  constexpr double kMad = 1.4826;
  constexpr double kFinest = 5e-4; // radians; below it, what was sharpest would rule alone
  return std::max(kMad * *middle, kFinest);
}

double costOf(const Seen &seen, const Unknowns &x, double scale)
{
  constexpr double kHuber = 2.0;
  const std::vector<Pose2> places = seen.way.places(x);
  double sum = 0.0;
  for (const Sight &sight : seen.sights) {
    const double s = std::abs(residual(sight, places, seen.way.own(), x)) / scale;
    sum += s <= kHuber ? s * s : 2.0 * kHuber * s - kHuber * kHuber;
  }
  for (Eigen::Index step = 0; step < seen.way.own() - kMount; ++step) {
    const double s = x[kMount + step] / seen.way.sigma(step);
    sum += s * s;
  }
  return sum;
}

/** Normal equations of the way's unknowns and of landmarks, which meet only in the former. */
struct NormalEquations
{
  /** One landmark's part. */
  struct Landmark
  {
    Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
    Eigen::MatrixX2d withWay;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  };

  Eigen::MatrixXd way;
  Eigen::VectorXd gradient;
  std::vector<Landmark> landmarks;

  NormalEquations(const Seen &seen, const Unknowns &x, double scale)
  {
    const Eigen::Index own = seen.way.own();
    way.setZero(own, own);
    gradient.setZero(own);
    landmarks.resize(static_cast<std::size_t>((x.size() - own) / 2));
    for (Landmark &landmark : landmarks) {
      landmark.withWay.setZero(own, 2);
    }
    const std::vector<Pose2> places = seen.way.places(x);
    Eigen::RowVectorXd J;
    Eigen::RowVector2d Jl;
    for (const Sight &sight : seen.sights) {
      const double error = residual(sight, places, own, x, &J, &Jl);
      const double weight = weightOf(error, scale);
      const Eigen::Index used = kMount + static_cast<Eigen::Index>(sight.place);
      const auto Jw = J.head(used);
      Landmark &landmark = landmarks[static_cast<std::size_t>(sight.landmark)];
      way.topLeftCorner(used, used).noalias() += weight * Jw.transpose() * Jw;
      gradient.head(used) += weight * error * Jw.transpose();
      landmark.own += weight * Jl.transpose() * Jl;
      landmark.withWay.topRows(used) += weight * Jw.transpose() * Jl;
      landmark.gradient += weight * error * Jl.transpose();
    }
    for (Eigen::Index step = 0; step < own - kMount; ++step) {
      const double weight = scale * scale / (seen.way.sigma(step) * seen.way.sigma(step));
      way(kMount + step, kMount + step) += weight;
      gradient[kMount + step] -= weight * x[kMount + step];
    }
  }

  /** Every diagonal element grows by its share, as Marquardt has it. */
  void damp(double share)
  {
    constexpr double kLeast = 1e-12;
    way.diagonal() *= 1.0 + share;
    way.diagonal().array() += kLeast;
    for (Landmark &landmark : landmarks) {
      landmark.own.diagonal() *= 1.0 + share;
      landmark.own.diagonal().array() += kLeast;
    }
  }

  /** What is left for the way when every landmark follows it (Schur's complement). */
  Eigen::MatrixXd reduced() const
  {
    Eigen::MatrixXd S = way;
    for (const Landmark &landmark : landmarks) {
      const Eigen::MatrixX2d half = landmark.withWay * landmark.own.inverse();
      S.noalias() -= half * landmark.withWay.transpose();
    }
    return S;
  }

  Unknowns solve() const
  {
    Eigen::VectorXd right = gradient;
    for (const Landmark &landmark : landmarks) {
      right -= landmark.withWay * (landmark.own.inverse() * landmark.gradient);
    }
    const Eigen::Index own = way.rows();
    Unknowns step(own + 2 * static_cast<Eigen::Index>(landmarks.size()));
    step.head(own) = reduced().ldlt().solve(right);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Landmark &landmark = landmarks[i];
      step.segment<2>(own + 2 * static_cast<Eigen::Index>(i)) =
          landmark.own.inverse() *
          (landmark.gradient - landmark.withWay.transpose() * step.head(own));
    }
    return step;
  }
};

Unknowns refined(const Seen &seen, Unknowns x, int steps)
{
  double damping = 1e-3;
  for (int i = 0; i < steps; ++i) {
    const double scale = scaleOf(seen, x);
    const double cost = costOf(seen, x, scale);
    NormalEquations equations(seen, x, scale);
    equations.damp(damping);
    const Unknowns next = x + equations.solve();
    if (next.allFinite() && costOf(seen, next, scale) <= cost) {
      const bool rests = (next - x).norm() < 1e-7;
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
  const double yaw = std::sqrt(covariance(2, 2));
  const double offset = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  if (!covariance.allFinite() || !(yaw < kYaw) || !(offset < kOffset)) {
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
  double sum = 0.0;
  double weighted = 0.0;
  const std::vector<Pose2> places = seen.way.places(best);
  for (const Sight &sight : seen.sights) {
    const double error = residual(sight, places, seen.way.own(), best);
    sum += error * error;
    weighted += weightOf(error, scale) * error * error;
  }
  NormalEquations equations(seen, best, scale);
  equations.damp(0.0);
  const double spare = std::max(static_cast<double>(seen.sights.size()) - double(best.size()), 1.0);
  const Eigen::MatrixXd covariance = equations.reduced().inverse() * weighted / spare;
  estimate.covariance = covariance.topLeftCorner<kMount, kMount>();
  estimate.rms = std::sqrt(sum / static_cast<double>(seen.sights.size()));
  estimate.rMp = {best[0], best[1], wrapAngle(best[2])};
  const std::vector<Direction> directions = directionsOf(seen, best);
  checkAllRound(directions);
  estimate.covariance = widened(estimate.covariance, seen, best, directions);
  checkEstimate(estimate, scale);
  return estimate;
}

} // namespace homeward
