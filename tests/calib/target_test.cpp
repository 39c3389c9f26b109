// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_picture.h"

#include <homeward/calib/target.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>

#include <array>

namespace homeward
{
namespace
{

constexpr std::array kKinds{TargetKind::Chessboard, TargetKind::CircleGrid, TargetKind::AprilGrid,
                            TargetKind::Charuco};

Target targetOf(TargetKind kind)
{
  return {kind, 7, 5, 0.04};
}

TEST(Target, namesAreReadBack)
{
  for (const TargetKind kind : kKinds) {
    EXPECT_EQ(targetKindOf(nameOf(kind)), kind);
  }
  EXPECT_THROW(targetKindOf("checkers"), ConfigError);
}

TEST(Target, hasAsManyPointsAsItsKindSays)
{
  EXPECT_EQ(targetPoints(targetOf(TargetKind::Chessboard)).size(), 7U * 5U);
  EXPECT_EQ(targetPoints(targetOf(TargetKind::CircleGrid)).size(), 7U * 5U);
  EXPECT_EQ(targetPoints(targetOf(TargetKind::AprilGrid)).size(), 7U * 5U * 4U);
  EXPECT_EQ(targetPoints(targetOf(TargetKind::Charuco)).size(), 6U * 4U);
}

/** Gray level of the art, metres from its top left corner. */
int levelAt(const cv::Mat1b &art, double x, double y)
{
  return art(static_cast<int>(y * 10000.0), static_cast<int>(x * 10000.0));
}

TEST(Target, chessboardCornersHaveBlackAcrossFromBlack)
{
  for (const TargetKind kind : {TargetKind::Chessboard, TargetKind::Charuco}) {
    const TargetArt art = drawTarget(targetOf(kind));
    const cv::Mat1b image = rasterise(art, 10000.0);
    for (const Eigen::Vector3d &point : targetPoints(targetOf(kind))) {
      const double x = art.origin.x() + point.x();
      const double y = art.origin.y() + point.y();
      constexpr double kAside = 0.002;
      EXPECT_EQ(levelAt(image, x - kAside, y - kAside), levelAt(image, x + kAside, y + kAside));
      EXPECT_EQ(levelAt(image, x + kAside, y - kAside), levelAt(image, x - kAside, y + kAside));
      EXPECT_NE(levelAt(image, x - kAside, y - kAside), levelAt(image, x + kAside, y - kAside));
    }
  }
}

TEST(Target, everyTagCornerIsBlackInsideAndWhiteOutside)
{
  const Target target = targetOf(TargetKind::AprilGrid);
  const TargetArt art = drawTarget(target);
  const cv::Mat1b image = rasterise(art, 10000.0);
  const auto points = targetPoints(target);
  for (std::size_t i = 0; i < points.size(); i += 4) {
    const Eigen::Vector3d middle = (points[i] + points[i + 2]) / 2.0;
    for (std::size_t k = i; k < i + 4; ++k) {
      const Eigen::Vector2d corner = art.origin + points[k].head<2>();
      const Eigen::Vector2d inwards = 0.04 * (middle - points[k]).head<2>();
      EXPECT_EQ(levelAt(image, corner.x() + inwards.x(), corner.y() + inwards.y()), 0);
      EXPECT_EQ(levelAt(image, corner.x() - inwards.x(), corner.y() - inwards.y()), 255);
    }
  }
}

TEST(Target, artKeepsAWhiteMargin)
{
  for (const TargetKind kind : kKinds) {
    const TargetArt art = drawTarget(targetOf(kind));
    const cv::Mat1b image = rasterise(art, 1000.0);
    const int margin = 20; // half a pitch, in millimetres
    EXPECT_EQ(cv::countNonZero(image.rowRange(0, margin) < 255), 0) << nameOf(kind);
    EXPECT_EQ(cv::countNonZero(image.rowRange(image.rows - margin, image.rows) < 255), 0);
    EXPECT_EQ(cv::countNonZero(image.colRange(0, margin) < 255), 0);
    EXPECT_EQ(cv::countNonZero(image.colRange(image.cols - margin, image.cols) < 255), 0);
    EXPECT_GT(cv::countNonZero(image < 128), 0);
  }
}

TEST(Target, refusesWhatCannotBePrinted)
{
  EXPECT_THROW(checkTarget({TargetKind::Chessboard, 2, 6, 0.03}), ConfigError);
  EXPECT_THROW(checkTarget({TargetKind::Chessboard, 9, 6, 0.0}), ConfigError);
  EXPECT_THROW(checkTarget({TargetKind::AprilGrid, 50, 50, 0.03}), ConfigError);
  EXPECT_THROW(checkTarget({TargetKind::Charuco, 7, 5, 0.03, 0.03}), ConfigError);
}

} // namespace
} // namespace homeward
