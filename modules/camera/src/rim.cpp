// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/rim.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{
namespace
{

constexpr int kDirections = 720;
constexpr double kStep = 0.5;    ///< pixels between radii
constexpr int kReach = 40;       ///< steps on both sides of the rim
constexpr int kHalfStep = 3;     ///< half the steps between the two radii that are compared
constexpr float kMostFall = 40;  ///< gray levels; a lamp at the rim must not decide alone
constexpr float kLeastFall = 1;  ///< gray levels, mean all round
constexpr float kDistinct = 1.5; ///< times the fall at the best circle well aside

/** How unlike the mount it is along the radii round a circle: row: direction, column: radius. */
struct Radii
{
  cv::Mat1f levels; ///< gray levels
  std::vector<Eigen::Vector2d> directions;

  static constexpr int kColumns = 2 * (kReach + kHalfStep) + 1;

  /** Pixels outside the circle that a column stands for. */
  static double radius(int column) { return kStep * (column - kReach - kHalfStep); }
};

/** Averages neighbouring directions, against noise. */
cv::Mat smoothed(const cv::Mat &radii)
{
  constexpr int kAlong = 9;
  cv::Mat wrapped;
  cv::Mat smooth;
  cv::copyMakeBorder(radii, wrapped, kAlong / 2, kAlong / 2, 0, 0, cv::BORDER_WRAP);
  cv::blur(wrapped, smooth, {1, kAlong});
  return smooth.rowRange(kAlong / 2, kAlong / 2 + radii.rows);
}

/**
 * Difference of colour from that of the last columns, which show the mount: by night the scene may
 * be as dark as it, but hardly of the same colour.
 */
cv::Mat1f unlikeMount(const cv::Mat &colours)
{
  constexpr int kMount = 8; // columns
  cv::Mat mount;
  cv::reduce(colours.colRange(colours.cols - kMount, colours.cols), mount, 1, cv::REDUCE_AVG);
  cv::Mat all;
  cv::repeat(mount, 1, colours.cols, all);
  cv::Mat difference = colours - all;
  difference = difference.mul(difference);
  cv::Mat squares = difference.reshape(1, colours.rows * colours.cols);
  cv::Mat sums;
  cv::reduce(squares, sums, 1, cv::REDUCE_SUM);
  cv::Mat1f lengths;
  cv::sqrt(sums.reshape(1, colours.rows), lengths);
  return lengths;
}

/** @param picture CV_32FC1 or CV_32FC3 */
Radii radiiRound(const cv::Mat &picture, const Eigen::Vector2d &centre, double radius)
{
  cv::Mat1f u(kDirections, Radii::kColumns);
  cv::Mat1f v(kDirections, Radii::kColumns);
  Radii radii;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2.0 * kPi * k / kDirections;
    radii.directions.emplace_back(std::cos(angle), std::sin(angle));
    for (int i = 0; i < Radii::kColumns; ++i) {
      const Eigen::Vector2d pixel = centre + (radius + Radii::radius(i)) * radii.directions.back();
      u(k, i) = static_cast<float>(pixel.x());
      v(k, i) = static_cast<float>(pixel.y());
    }
  }
  // Beyond the picture nothing is known, so nothing changes.
  cv::Mat colours;
  cv::remap(picture, colours, u, v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  radii.levels = unlikeMount(smoothed(colours));
  return radii;
}

/** How much more like the mount it gets outwards at radii round the rim, by direction. */
struct Falls
{
  cv::Mat1f values; ///< row: direction, column: radius
  std::vector<Eigen::Vector2d> directions;

  explicit Falls(const Radii &radii)
      : values(kDirections, 2 * kReach + 1), directions(radii.directions)
  {
    for (int k = 0; k < kDirections; ++k) {
      for (int i = 0; i <= 2 * kReach; ++i) {
        const float fall = radii.levels(k, i) - radii.levels(k, i + 2 * kHalfStep);
        values(k, i) = std::clamp(fall, -kMostFall, kMostFall);
      }
    }
  }

  /** Mean over directions where the rim of a circle moved by `shift` would be. */
  float at(const Eigen::Vector2d &shift) const
  {
    float sum = 0.0F;
    for (int k = 0; k < kDirections; ++k) {
      const double radius = kReach + shift.dot(directions[static_cast<std::size_t>(k)]) / kStep;
      const int whole = static_cast<int>(radius);
      const auto part = static_cast<float>(radius - whole);
      const float *row = values[k];
      sum += row[whole] + part * (row[whole + 1] - row[whole]);
    }
    return sum / kDirections;
  }
};

/** The shift with the steepest fall, to a pixel or so. */
Eigen::Vector2d steepest(const Falls &falls)
{
  constexpr double kSpacing = 0.5; // pixels
  constexpr int kSteps = static_cast<int>(kMostRimShift / kSpacing);
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  float most = falls.at(best);
  for (int y = -kSteps; y <= kSteps; ++y) {
    for (int x = -kSteps; x <= kSteps; ++x) {
      const Eigen::Vector2d shift = kSpacing * Eigen::Vector2d(x, y);
      const float fall = shift.norm() <= kMostRimShift ? falls.at(shift) : 0.0F;
      if (fall > most) {
        most = fall;
        best = shift;
      }
    }
  }
  return best;
}

/** Whether the rim is where it falls, and not just anywhere about there. */
bool isDistinct(const Falls &falls, const Eigen::Vector2d &shift)
{
  constexpr double kAside = 4.0; // pixels
  const float here = falls.at(shift);
  float aside = 0.0F;
  for (int k = 0; k < 8; ++k) {
    const double angle = kPi * k / 4.0;
    aside = std::max(aside,
                     falls.at(shift + kAside * Eigen::Vector2d(std::cos(angle), std::sin(angle))));
  }
  return here > kLeastFall && here > kDistinct * aside;
}

/** Where one radius crosses from the scene to the mount. */
struct Crossing
{
  Eigen::Vector2d direction;
  double radius = 0.0; ///< pixels outside the circle
  double weight = 0.0;
};

/** The last radius at which it is half way between the scene and the mount. */
std::optional<Crossing> crossingOf(const float *levels, const Eigen::Vector2d &direction)
{
  constexpr int kMiddle = kReach + kHalfStep;
  constexpr int kFar = 8;  // columns from the circle, ...
  constexpr int kNear = 4; // ... where it is one or the other for sure
  float inside = 0.0F;
  float outside = 0.0F;
  for (int i = kNear; i < kFar; ++i) {
    inside += levels[kMiddle - i] / (kFar - kNear);
    outside += levels[kMiddle + i] / (kFar - kNear);
  }
  const float half = (inside + outside) / 2.0F;
  if (inside - outside < kLeastFall) {
    return std::nullopt;
  }
  for (int i = kMiddle + kFar; i-- > kMiddle - kFar;) {
    if (levels[i] >= half && levels[i + 1] < half) {
      const double part = (levels[i] - half) / (levels[i] - levels[i + 1]);
      return Crossing{direction, Radii::radius(i) + kStep * part,
                      std::pow(std::min(inside - outside, kMostFall), 2)};
    }
  }
  return std::nullopt;
}

/** The shift of a circle that its crossings ask for, least squares with Huber's weights. */
std::optional<Eigen::Vector2d> fittedShift(const Radii &radii)
{
  std::vector<Crossing> crossings;
  for (int k = 0; k < kDirections; ++k) {
    if (const auto crossing =
            crossingOf(radii.levels[k], radii.directions[static_cast<std::size_t>(k)])) {
      crossings.push_back(*crossing);
    }
  }
  if (crossings.size() < kDirections / 3) {
    return std::nullopt;
  }
  constexpr int kIterations = 10;
  constexpr double kSharp = 0.3;               // pixels; what is farther off counts less
  Eigen::Vector3d x = Eigen::Vector3d::Zero(); // shift and growth of the radius
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix3d A = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Crossing &crossing : crossings) {
      const Eigen::Vector3d row(crossing.direction.x(), crossing.direction.y(), 1.0);
      const double off = std::abs(crossing.radius - row.dot(x));
      const double weight = crossing.weight * (off > kSharp ? kSharp / off : 1.0);
      A += weight * row * row.transpose();
      b += weight * crossing.radius * row;
    }
    x = A.inverse() * b;
  }
  return x.head<2>();
}

} // namespace

std::optional<Eigen::Vector2d> rimShift(const cv::Mat &picture, const MirrorCamera &camera)
{
  if (picture.size() != cv::Size(camera.model.width(), camera.model.height()) ||
      (picture.type() != CV_8UC1 && picture.type() != CV_8UC3)) {
    throw LogicError("the rim is looked for in an 8-bit picture of the camera's size, " +
                     std::to_string(camera.model.width()) + " x " +
                     std::to_string(camera.model.height()));
  }
  if (!camera.rim) {
    return std::nullopt;
  }
  cv::Mat colours;
  picture.convertTo(colours, CV_32F);
  const Radii all = radiiRound(colours, camera.rim->centre, camera.rim->radius);
  const Falls falls(all);
  const Eigen::Vector2d rough = steepest(falls);
  if (!isDistinct(falls, rough)) {
    return std::nullopt;
  }
  const auto more =
      fittedShift(radiiRound(colours, camera.rim->centre + rough, camera.rim->radius));
  constexpr double kMostCorrected = 2.0; // pixels
  if (!more || more->norm() > kMostCorrected) {
    return std::nullopt;
  }
  return rough + *more;
}

MirrorCamera followRim(const MirrorCamera &camera, const std::vector<Eigen::Vector2d> &shifts)
{
  if (shifts.empty() || !camera.rim) {
    return camera;
  }
  std::vector<double> x;
  std::vector<double> y;
  for (const Eigen::Vector2d &shift : shifts) {
    x.push_back(shift.x());
    y.push_back(shift.y());
  }
  const auto middle = [](std::vector<double> &values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
  };
  const Eigen::Vector2d shift(middle(x), middle(y));
  UnifiedCamera::Parameters parameters = camera.model.parameters();
  parameters.cx += shift.x();
  parameters.cy += shift.y();
  MirrorCamera now = camera;
  now.model = UnifiedCamera(parameters, camera.model.width(), camera.model.height());
  now.rim->centre += shift;
  return now;
}

} // namespace homeward
