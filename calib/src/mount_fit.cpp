// SPDX-License-Identifier: GPL-3.0-or-later
#include "mount_fit.h"

#include <homeward/core/angle.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

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

double weightOf(double error, double scale)
{
  constexpr double kHuber = 2.0;
  return std::abs(error) <= kHuber * scale ? 1.0 : kHuber * scale / std::abs(error);
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

} // namespace

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

MountSpread spreadOf(const Seen &seen, const Unknowns &x, double scale)
{
  double sum = 0.0;
  double weighted = 0.0;
  const std::vector<Pose2> places = seen.way.places(x);
  for (const Sight &sight : seen.sights) {
    const double error = residual(sight, places, seen.way.own(), x);
    sum += error * error;
    weighted += weightOf(error, scale) * error * error;
  }
  NormalEquations equations(seen, x, scale);
  equations.damp(0.0);
  const auto count = static_cast<double>(seen.sights.size());
  const double spare = std::max(count - static_cast<double>(x.size()), 1.0);
  const Eigen::MatrixXd covariance = equations.reduced().inverse() * weighted / spare;
  return {covariance.topLeftCorner<kMount, kMount>(), std::sqrt(sum / count)};
}

} // namespace homeward
