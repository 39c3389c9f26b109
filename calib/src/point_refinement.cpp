// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_refinement.h"

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
  constexpr double kLeastPitch = 2.0; // pixels
  if (std::min(across, down) < kLeastPitch) {
    result.image = cv::Mat1f::zeros(side, side);
    return result;
  }
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
  map -= cv::Scalar(box.x, box.y);
  cv::remap(real, result.image, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  // Jagged edges would pull the point along; a blur moves nothing that is symmetric on the board.
  const double blur = std::clamp(kBlurShare * std::min(across, down), 0.3, kMostBlur);
  cv::GaussianBlur(result.image, result.image, {}, blur / (across * result.step),
                   blur / (down * result.step));
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

/**
 * Whether the checkers round a corner show as far as `reach`: those across from each other are
 * alike, which the mirror's rim or a hand in front of one of them spoils.
 */
bool showsWholeCheckers(const cv::Mat1b &picture, const ToPicture &toPicture,
                        const Eigen::Vector2d &corner, double reach, double contrast)
{
  constexpr double kAlike = 0.45; // of the contrast
  const auto level = [&](double x, double y) {
    return static_cast<double>(
        bilinear(picture, toPicture(corner + reach * Eigen::Vector2d(x, y))));
  };
  for (const double right : {0.4, 0.6, 0.8}) {
    for (const double down : {-0.8, -0.6, -0.4, 0.4, 0.6, 0.8}) {
      if (std::abs(level(right, down) - level(-right, -down)) > kAlike * contrast) {
        return false;
      }
    }
  }
  return true;
}

/** Whether the border shows paper: what the rim or a hand cuts is no whole disc. */
bool paperAllRound(const Sampled &sampled)
{
  const auto [dark, bright] = levels(sampled.image);
  const float least = 0.5F * (dark + bright);
  const int last = 2 * sampled.half;
  for (int i = 0; i <= last; ++i) {
    for (const float level : {sampled.image(0, i), sampled.image(last, i), sampled.image(i, 0),
                              sampled.image(i, last)}) {
      if (level < least) {
        return false;
      }
    }
  }
  return true;
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
  constexpr double kFarthest = 0.3; // pitches
  return moved.norm() < kFarthest &&
                 showsWholeCheckers(picture, toPicture, moved, reach, bright - dark)
             ? std::optional(toPicture(moved))
             : std::nullopt;
}

std::optional<Eigen::Vector2d> refineDisc(const cv::Mat1b &picture, const ToPicture &toPicture)
{
  constexpr double kAround = 0.42; // pitches, not as far as the next disc
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  for (int pass = 0; pass < 3; ++pass) {
    const Sampled sampled = sample(picture, toPicture, moved, kAround);
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
  constexpr double kFarthest = 0.3; // pitches
  return moved.norm() < kFarthest && paperAllRound(sample(picture, toPicture, moved, kAround))
             ? std::optional(toPicture(moved))
             : std::nullopt;
}

} // namespace homeward
