// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_refinement.h"

#include <homeward/core/symmetric_eigen.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace homeward
{
namespace
{

/** The picture resampled along the board's own directions. */
struct Sampled
{
  cv::Mat1f image;
  int half = 0;      ///< samples from the middle to the border
  double step = 0.0; ///< from one sample to the next, pitches
};

constexpr double kMostBlur = 1.0;  ///< pixels
constexpr double kBlurShare = 0.1; ///< of the pitch, so that small checkers stay apart

/** @param reach from `middle` to the border, both in pitches */
Sampled sample(const cv::Mat1b &picture, const ToPicture &toPicture, const Eigen::Vector2d &middle,
               double reach)
{
  const double across = (toPicture({0.5, 0.0}) - toPicture({-0.5, 0.0})).norm();
  const double down = (toPicture({0.0, 0.5}) - toPicture({0.0, -0.5})).norm();
  Sampled result;
  result.half = std::clamp(static_cast<int>(std::ceil(std::max(across, down) * reach)), 4, 20);
  result.step = reach / result.half;
  const int side = 2 * result.half + 1;
  cv::Mat2f map(side, side);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Eigen::Vector2d offset(column - result.half, row - result.half);
      const Eigen::Vector2d pixel = toPicture(middle + result.step * offset);
      map(row, column) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  }
  cv::Mat real;
  // Only the neighbourhood is turned to floats.
  cv::Rect box = cv::boundingRect(map.reshape(2, side * side));
  box = (box + cv::Size(8, 8) - cv::Point(4, 4)) & cv::Rect({}, picture.size());
  if (box.empty()) {
    result.image = cv::Mat1f::zeros(side, side);
    return result;
  }
  picture(box).convertTo(real, CV_32F);
  // Jagged edges would pull the point along; a blur moves nothing that is symmetric.
  const double blur = std::clamp(kBlurShare * std::min(across, down), 0.3, kMostBlur);
  cv::GaussianBlur(real, real, {}, blur);
  map -= cv::Scalar(box.x, box.y);
  cv::remap(real, result.image, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
}

/** Darkest and brightest, but for a few. */
std::pair<float, float> levels(const cv::Mat1f &image)
{
  std::vector<float> sorted(image.begin(), image.end());
  const std::size_t few = sorted.size() / 12;
  std::sort(sorted.begin(), sorted.end());
  return {sorted[few], sorted[sorted.size() - 1 - few]};
}

constexpr float kLeastContrast = 12.0F; ///< gray levels

/** Position of the steepest rise along a profile, its gradient's centre of mass; in samples. */
std::optional<double> risingEdge(const std::vector<float> &profile)
{
  const auto size = static_cast<int>(profile.size());
  int best = 1;
  const auto slope = [&](int i) {
    return profile[static_cast<std::size_t>(i) + 1] - profile[static_cast<std::size_t>(i) - 1];
  };
  for (int i = 1; i + 1 < size; ++i) {
    best = slope(i) > slope(best) ? i : best;
  }
  if (slope(best) < kLeastContrast) {
    return std::nullopt;
  }
  double weight = 0.0;
  double sum = 0.0;
  for (int i = std::max(1, best - 3); i <= std::min(size - 2, best + 3); ++i) {
    const double w =
        std::max(0.0, static_cast<double>(slope(i)) - 0.15 * static_cast<double>(slope(best)));
    weight += w;
    sum += w * i;
  }
  return sum / weight;
}

template <class T> float bilinear(const cv::Mat_<T> &picture, const Eigen::Vector2d &pixel)
{
  const auto u = static_cast<int>(std::floor(pixel.x()));
  const auto v = static_cast<int>(std::floor(pixel.y()));
  if (u < 0 || v < 0 || u + 1 >= picture.cols || v + 1 >= picture.rows) {
    return 0.0F;
  }
  const auto a = static_cast<float>(pixel.x() - u);
  const auto b = static_cast<float>(pixel.y() - v);
  return (1.0F - b) * ((1.0F - a) * picture(v, u) + a * picture(v, u + 1)) +
         b * ((1.0F - a) * picture(v + 1, u) + a * picture(v + 1, u + 1));
}

/** The line n . x = c through one edge of the unit square, in the square's frame, n outwards. */
std::optional<Eigen::Vector3d> edgeLine(const cv::Mat1b &picture, const ToPicture &toPicture,
                                        const Eigen::Vector2d &from, const Eigen::Vector2d &to)
{
  const Eigen::Vector2d along = to - from;
  const Eigen::Vector2d outwards(along.y(), -along.x());
  const double reach = 0.09; // less than a marker's cell
  const double length = (toPicture(from) - toPicture(to)).norm();
  const int samples = std::clamp(static_cast<int>(length), 6, 40);
  const double pixels =
      (toPicture(from + 0.5 * along + reach * outwards) - toPicture(from + 0.5 * along)).norm();
  const int half = std::clamp(static_cast<int>(std::ceil(2.0 * pixels)), 4, 12);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d middle = from + (0.08 + 0.84 * (i + 0.5) / samples) * along;
    std::vector<float> profile;
    for (int k = -half; k <= half; ++k) {
      profile.push_back(bilinear(picture, toPicture(middle + reach * k / half * outwards)));
    }
    if (const auto edge = risingEdge(profile)) {
      points.emplace_back(middle + reach * (*edge - half) / half * outwards);
    }
  }
  if (static_cast<int>(points.size()) < (samples + 1) / 2) {
    return std::nullopt;
  }
  // Twice: the second time without what lies far from the first line.
  Eigen::Vector3d line;
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto &point : points) {
      mean += point / static_cast<double>(points.size());
    }
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto &point : points) {
      spread += (point - mean) * (point - mean).transpose();
    }
    const SymmetricEigen principal = symmetricEigen(spread);
    const Eigen::Vector2d normal = principal.vectors.col(0);
    line << normal, -normal.dot(mean);
    const double sigma = std::sqrt(principal.values[0] / static_cast<double>(points.size()));
    std::erase_if(points, [&](const Eigen::Vector2d &point) {
      return std::abs(line.dot(point.homogeneous())) > 2.0 * sigma + 1e-9;
    });
    if (points.size() < 3) {
      return std::nullopt;
    }
  }
  return line;
}

/**
 * Moves a point to where the picture round it looks the same after half a turn, which holds for
 * any blur; Gauss-Newton on I(c + d) - I(c - d). In samples.
 */
Eigen::Vector2d settleOnSymmetry(const cv::Mat1f &image, Eigen::Vector2d c, int window)
{
  cv::Mat1f dx;
  cv::Mat1f dy;
  cv::Scharr(image, dx, CV_32F, 1, 0, 1.0 / 32.0);
  cv::Scharr(image, dy, CV_32F, 0, 1, 1.0 / 32.0);
  for (int i = 0; i < 15; ++i) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Identity() * 1e-6;
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (int y = 0; y <= window; ++y) {
      for (int x = y == 0 ? 1 : -window; x <= window; ++x) { // half of them: d and -d are one pair
        const Eigen::Vector2d d(x, y);
        const double weight = std::exp(-1.5 * d.squaredNorm() / (window * window));
        const Eigen::Vector2d J(bilinear(dx, c + d) - bilinear(dx, c - d),
                                bilinear(dy, c + d) - bilinear(dy, c - d));
        const auto e = static_cast<double>(bilinear(image, c + d) - bilinear(image, c - d));
        A += weight * J * J.transpose();
        b += weight * e * J;
      }
    }
    const Eigen::Vector2d move = A.inverse() * b;
    c -= move;
    if (!(move.norm() > 1e-4) || !(move.norm() < window)) {
      break;
    }
  }
  return c;
}

} // namespace

std::optional<Eigen::Vector2d> refineSaddle(const cv::Mat1b &picture, const ToPicture &toPicture,
                                            double reach)
{
  const Sampled sampled = sample(picture, toPicture, {0.0, 0.0}, 1.4 * reach);
  const auto [dark, bright] = levels(sampled.image);
  if (bright - dark < kLeastContrast) {
    return std::nullopt;
  }
  const int window = std::clamp(cvRound(sampled.half / 1.4), 2, sampled.half - 2);
  const auto middle = static_cast<float>(sampled.half);
  std::vector<cv::Point2f> corner{{middle, middle}};
  cv::cornerSubPix(sampled.image, corner, {window, window}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 1e-4});
  const Eigen::Vector2d settled =
      settleOnSymmetry(sampled.image, {corner[0].x, corner[0].y}, window);
  const Eigen::Vector2d moved = sampled.step * (settled - Eigen::Vector2d(middle, middle));
  return moved.norm() < 0.3 ? std::optional(toPicture(moved)) : std::nullopt;
}

bool showsWholeCheckers(const cv::Mat1b &picture, const ToPicture &toPicture)
{
  constexpr double kAlike = 0.45; // of the contrast
  const auto level = [&](double x, double y) {
    return static_cast<double>(bilinear(picture, toPicture({x, y})));
  };
  const double contrast =
      std::abs(level(0.2, 0.2) + level(-0.2, -0.2) - level(0.2, -0.2) - level(-0.2, 0.2)) / 2.0;
  for (const double right : {0.2, 0.3, 0.4}) {
    for (const double down : {-0.4, -0.3, -0.2, 0.2, 0.3, 0.4}) {
      if (std::abs(level(right, down) - level(-right, -down)) > kAlike * contrast) {
        return false;
      }
    }
  }
  return true;
}

std::optional<Eigen::Vector2d> refineDisc(const cv::Mat1b &picture, const ToPicture &toPicture)
{
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  for (int pass = 0; pass < 3; ++pass) {
    const Sampled sampled = sample(picture, toPicture, moved, 0.42);
    const auto [dark, bright] = levels(sampled.image);
    const auto contrast = static_cast<double>(bright - dark);
    if (contrast < static_cast<double>(kLeastContrast)) {
      return std::nullopt;
    }
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double weight = 0.0;
    for (int row = 0; row < sampled.image.rows; ++row) {
      for (int column = 0; column < sampled.image.cols; ++column) {
        const auto below = static_cast<double>(bright - sampled.image(row, column));
        const double w = std::clamp(below / contrast - 0.05, 0.0, 1.0);
        weight += w;
        sum += w * Eigen::Vector2d(column - sampled.half, row - sampled.half);
      }
    }
    moved += sum / std::max(weight, 1e-9) * sampled.step;
  }
  return moved.norm() < 0.3 ? std::optional(toPicture(moved)) : std::nullopt;
}

std::optional<std::array<Eigen::Vector2d, 4>> refineSquare(const cv::Mat1b &picture,
                                                           const ToPicture &toPicture)
{
  const std::array<Eigen::Vector2d, 4> corners{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
  std::array<Eigen::Vector3d, 4> lines;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto line = edgeLine(picture, toPicture, corners[i], corners[(i + 1) % 4]);
    if (!line) {
      return std::nullopt;
    }
    lines[i] = *line;
  }
  std::array<Eigen::Vector2d, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d crossing = lines[(i + 3) % 4].cross(lines[i]);
    const Eigen::Vector2d corner = crossing.hnormalized();
    if (!((corner - corners[i]).norm() < 0.15)) {
      return std::nullopt;
    }
    result[i] = toPicture(corner);
  }
  return result;
}

} // namespace homeward
