// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/radial_start.h>

#include <homeward/core/symmetric_eigen.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

using RadialRow = Eigen::Matrix<double, 8, 1>; ///< (h1 h2 h3 t1 h4 h5 h6 t2); h3, h6 of solids only

/** A view's points round their mean along their principal axes, unit spread. */
struct Centred
{
  Eigen::Isometry3d oMp = Eigen::Isometry3d::Identity(); ///< principal axes in the target
  double spread = 1.0;                                   ///< metres
  bool flat = true;
  std::vector<Eigen::Vector3d> points;
};

std::optional<Centred> centred(const BoardView &view)
{
  constexpr std::size_t kFewest = 6;
  if (view.board.size() < kFewest) {
    return std::nullopt;
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d &point : view.board) {
    mean += point;
  }
  mean /= static_cast<double>(view.board.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d &point : view.board) {
    scatter += (point - mean) * (point - mean).transpose();
  }
  scatter /= static_cast<double>(view.board.size());
  const SymmetricEigen principal = symmetricEigen(scatter);
  const Eigen::Vector3d spreads = principal.values.cwiseMax(0.0).cwiseSqrt();
  constexpr double kLine = 0.02; // of the length
  constexpr double kFlat = 0.01;
  if (!(spreads[2] > 0.0) || spreads[1] < kLine * spreads[2]) {
    return std::nullopt;
  }
  Centred result;
  Eigen::Matrix3d axes = principal.vectors.rowwise().reverse();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  result.oMp.linear() = axes;
  result.oMp.translation() = mean;
  result.spread = spreads[2];
  result.flat = spreads[0] < kFlat * spreads[2];
  for (const Eigen::Vector3d &point : view.board) {
    result.points.emplace_back(result.oMp.inverse() * point / result.spread);
  }
  return result;
}

/** The two rows of the pose up to scale: least pixels across the radius, reweighted. */
RadialRow radialRows(const Centred &centred, const BoardView &view, const Eigen::Vector2d &centre,
                     double &rms)
{
  using Square = Eigen::Matrix<double, 8, 8>;
  const Eigen::VectorXi unknown = centred.flat ? Eigen::VectorXi{{0, 1, 3, 4, 5, 7}}
                                               : Eigen::VectorXi{{0, 1, 2, 3, 4, 5, 6, 7}};
  const Eigen::Index n = unknown.size();
  RadialRow h = RadialRow::Zero();
  std::vector<double> weights(view.pixels.size(), 1.0);
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    Square M = Square::Zero();
    for (std::size_t i = 0; i < view.pixels.size(); ++i) {
      const Eigen::Vector2d m = view.pixels[i] - centre;
      const Eigen::Vector4d point = centred.points[i].homogeneous();
      RadialRow row;
      row << -m.y() * point, m.x() * point;
      M.noalias() += weights[i] * row * row.transpose();
    }
    Eigen::MatrixXd ofUnknown(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k < n; ++k) {
        ofUnknown(i, k) = M(unknown[i], unknown[k]);
      }
    }
    const Eigen::VectorXd best = symmetricEigen(ofUnknown).vectors.col(0);
    for (Eigen::Index i = 0; i < n; ++i) {
      h[unknown[i]] = best[i];
    }
    double sum = 0.0;
    double along = 0.0;
    for (std::size_t i = 0; i < view.pixels.size(); ++i) {
      const Eigen::Vector2d m = view.pixels[i] - centre;
      const Eigen::Vector2d ab(h.segment<3>(0).dot(centred.points[i]) + h[3],
                               h.segment<3>(4).dot(centred.points[i]) + h[7]);
      const double length2 = std::max(ab.squaredNorm(), 1e-12);
      const double across = m.x() * ab.y() - m.y() * ab.x();
      sum += across * across / length2;
      along += m.dot(ab) / std::sqrt(length2);
      weights[i] = 1.0 / length2;
    }
    rms = std::sqrt(sum / static_cast<double>(view.pixels.size()));
    h = along < 0.0 ? RadialRow(-h) : h;
  }
  return h;
}

/** Rotation and first two coordinates from the rows; two answers of a flat target. */
std::vector<Eigen::Isometry3d> completed(const RadialRow &h, const Centred &centred)
{
  std::vector<Eigen::Isometry3d> poses;
  const auto add = [&](const Eigen::Vector3d &x, const Eigen::Vector3d &y, double scale) {
    // Principal axes in frame c, then the target.
    Eigen::Matrix3d R;
    R << x, y, x.cross(y);
    Eigen::Isometry3d cMp = Eigen::Isometry3d::Identity();
    cMp.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
    cMp.translation() = Eigen::Vector3d(h[3], h[7], 0.0) * (scale * centred.spread);
    poses.push_back(cMp * centred.oMp.inverse());
  };
  if (!centred.flat) {
    const Eigen::Vector3d x = h.segment<3>(0);
    const Eigen::Vector3d y = h.segment<3>(4);
    const double scale = 2.0 / (x.norm() + y.norm());
    Eigen::Matrix3d R;
    R.row(0) = x.normalized();
    R.row(1) = (y - y.dot(x) * x / x.squaredNorm()).normalized();
    R.row(2) = R.row(0).cross(R.row(1));
    add(R.col(0), R.col(1), scale);
    return poses;
  }
  const Eigen::Vector2d p(h[0], h[4]);
  const Eigen::Vector2d q(h[1], h[5]);
  const double difference = p.squaredNorm() - q.squaredNorm();
  const double product = p.dot(q);
  const double x2 =
      0.5 * (-difference + std::sqrt(difference * difference + 4.0 * product * product));
  const double x = std::sqrt(std::max(x2, 0.0));
  const double y = std::sqrt(std::max(x2 + difference, 0.0)) * (product > 0.0 ? -1.0 : 1.0);
  const double scale = 1.0 / std::sqrt(std::max(p.squaredNorm() + x * x, 1e-300));
  for (const double side : {1.0, -1.0}) {
    add(scale * Eigen::Vector3d(p.x(), p.y(), side * x),
        scale * Eigen::Vector3d(q.x(), q.y(), side * y), scale);
  }
  return poses;
}

double centreCost(const BoardViews &views, const std::vector<std::optional<Centred>> &prepared,
                  const Eigen::Vector2d &centre)
{
  // Robust: one bad view must not pull the centre.
  constexpr double kBad = 5.0; // pixels
  double sum = 0.0;
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    if (prepared[v]) {
      double rms = 0.0;
      radialRows(*prepared[v], views.views[v], centre, rms);
      sum += rms * rms / (1.0 + rms / kBad);
    }
  }
  return sum;
}

std::vector<std::optional<Centred>> prepare(const BoardViews &views)
{
  std::vector<std::optional<Centred>> prepared;
  for (const BoardView &view : views.views) {
    prepared.push_back(centred(view));
  }
  return prepared;
}

/** Pattern search from a guess. */
Eigen::Vector2d descended(const BoardViews &views,
                          const std::vector<std::optional<Centred>> &prepared,
                          Eigen::Vector2d centre, double step)
{
  constexpr double kFine = 0.25; // pixels
  double cost = centreCost(views, prepared, centre);
  while (step > kFine) {
    bool better = false;
    for (const Eigen::Vector2d &way : {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0),
                                       Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
      const Eigen::Vector2d next = centre + step * way;
      const double nextCost = centreCost(views, prepared, next);
      if (nextCost < cost) {
        cost = nextCost;
        centre = next;
        better = true;
      }
    }
    step = better ? step : 0.5 * step;
  }
  return centre;
}

/** Angle from the axis of a pixel's ray; nothing outside the unified model's domain. */
std::optional<double> rayAngle(double xi, double f, double radius)
{
  const double m = radius / f;
  const double inside = 1.0 + (1.0 - xi * xi) * m * m;
  if (inside < 0.0) {
    return std::nullopt;
  }
  const double scale = (xi + std::sqrt(inside)) / (1.0 + m * m);
  return std::atan2(scale * m, scale - xi);
}

/** Puts a view at the height that suits its rays; the mean squared error of the angles. */
double placeView(const BoardView &view, const std::vector<double> &angles, Eigen::Isometry3d &cMo)
{
  // z = across / tan(angle), weighted to angles: d angle = sin(angle)^2 / across d z.
  double sum = 0.0;
  double weights = 0.0;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < view.board.size(); ++i) {
    points.emplace_back(cMo * view.board[i]);
    const double across = std::max(points[i].head<2>().norm(), 1e-9);
    const double s = std::max(std::sin(angles[i]), 1e-3);
    const double weight = s * s * s * s / (across * across);
    sum += weight * (across * std::cos(angles[i]) / s - points[i].z());
    weights += weight;
  }
  const double height = sum / weights;
  double error = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = std::atan2(points[i].head<2>().norm(), points[i].z() + height);
    error += (angle - angles[i]) * (angle - angles[i]);
  }
  cMo.translation().z() += height;
  return error / static_cast<double>(points.size());
}

using RadialPoses = std::vector<std::optional<RadialPose>>;

std::optional<RadialStart> startOf(const BoardViews &views, const RadialPoses &poses, double xi,
                                   double f, const Eigen::Vector2d &centre)
{
  RadialStart start;
  start.xi = xi;
  start.f = f;
  start.centre = centre;
  double sum = 0.0;
  for (std::size_t v = 0; v < poses.size(); ++v) {
    if (!poses[v]) {
      return std::nullopt;
    }
    const BoardView &view = views.views[v];
    std::vector<double> angles;
    for (const Eigen::Vector2d &pixel : view.pixels) {
      const auto angle = rayAngle(xi, f, (pixel - centre).norm());
      if (!angle) {
        return std::nullopt;
      }
      angles.push_back(*angle);
    }
    double best = std::numeric_limits<double>::infinity();
    start.cMo.push_back(Eigen::Isometry3d::Identity());
    for (Eigen::Isometry3d cMo : poses[v]->cMos) {
      const double error = placeView(view, angles, cMo);
      if (error < best) {
        best = error;
        start.cMo.back() = cMo;
      }
    }
    sum += best;
  }
  start.error = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(poses.size(), 1)));
  return std::isfinite(start.error) ? std::optional(start) : std::nullopt;
}

/** Every so many points of each view: the scan over xi and f needs no more. */
BoardViews thinned(const BoardViews &views)
{
  constexpr std::size_t kEnough = 15;
  BoardViews few{views.width, views.height, {}};
  for (const BoardView &view : views.views) {
    BoardView thin;
    for (std::size_t i = 0; i < view.board.size(); i += 1 + view.board.size() / kEnough) {
      thin.board.push_back(view.board[i]);
      thin.pixels.push_back(view.pixels[i]);
    }
    few.views.push_back(std::move(thin));
  }
  return few;
}

RadialPoses radialPoses(const BoardViews &views, const Eigen::Vector2d &centre)
{
  RadialPoses poses;
  for (const BoardView &view : views.views) {
    poses.push_back(radialPose(view, centre));
  }
  return poses;
}

} // namespace

std::optional<RadialPose> radialPose(const BoardView &view, const Eigen::Vector2d &centre)
{
  const auto points = centred(view);
  if (!points) {
    return std::nullopt;
  }
  RadialPose pose;
  const RadialRow h = radialRows(*points, view, centre, pose.rms);
  pose.cMos = completed(h, *points);
  return pose;
}

Eigen::Vector2d radialCentre(const BoardViews &views)
{
  const auto prepared = prepare(views);
  constexpr int kCells = 8;
  Eigen::Vector2d best(0.5 * views.width, 0.5 * views.height);
  double cost = centreCost(views, prepared, best);
  for (int row = 1; row < kCells; ++row) {
    for (int column = 1; column < kCells; ++column) {
      const Eigen::Vector2d centre(views.width * column / double(kCells),
                                   views.height * row / double(kCells));
      const double here = centreCost(views, prepared, centre);
      if (here < cost) {
        cost = here;
        best = centre;
      }
    }
  }
  return descended(views, prepared, best, 0.5 * std::max(views.width, views.height) / kCells);
}

std::optional<RadialStart> radialStart(const BoardViews &views, double xi, double f,
                                       const Eigen::Vector2d &centre)
{
  return startOf(views, radialPoses(views, centre), xi, f, centre);
}

std::vector<RadialStart> radialStarts(const BoardViews &views, const Eigen::Vector2d &centre,
                                      int count)
{
  const RadialPoses poses = radialPoses(views, centre);
  const BoardViews few = thinned(views);
  std::vector<RadialStart> starts;
  for (const double xi : {0.0, 0.5, 0.8, 1.0, 1.3, 2.0}) {
    std::optional<RadialStart> best;
    const double largest = 3.0 * std::max(views.width, views.height);
    constexpr double kRatio = 1.2;
    for (double f = 0.02 * std::min(views.width, views.height); f < largest; f *= kRatio) {
      const auto start = startOf(few, poses, xi, f, centre);
      if (start && (!best || start->error < best->error)) {
        best = start;
      }
    }
    if (best) {
      starts.push_back(*best);
    }
  }
  std::sort(starts.begin(), starts.end(),
            [](const RadialStart &a, const RadialStart &b) { return a.error < b.error; });
  starts.resize(std::min(starts.size(), static_cast<std::size_t>(std::max(count, 0))));
  return starts;
}

} // namespace homeward
