// SPDX-License-Identifier: GPL-3.0-or-later
#include "../../modules/homing/src/scale_matches.h"
#include "../../modules/homing/src/upright_features.h"
#include "synthetic_room.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

constexpr double kContrast = 0.015;

/** A dark picture with round bright spots, each a Gaussian. */
cv::Mat spots(const std::vector<cv::Point3d> &centresAndSigmas)
{
  cv::Mat picture(160, 720, CV_8U);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      double value = 20.0;
      for (const cv::Point3d &spot : centresAndSigmas) {
        const double across = std::remainder(u - spot.x, picture.cols);
        const double down = v - spot.y;
        value += 200.0 * std::exp(-(across * across + down * down) / (2.0 * spot.z * spot.z));
      }
      picture.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(value);
    }
  }
  return picture;
}

TEST(UprightFeatures, tellPlaceAndScaleOfASpot)
{
  for (const double sigma : {2.5, 4.0, 7.0}) {
    const UprightFeatures found = uprightFeatures(spots({{300.3, 80.6, sigma}}), kContrast, 10);
    ASSERT_EQ(found.points.size(), 1U) << sigma;
    EXPECT_NEAR(found.points[0].pt.x, 300.3, 0.15) << sigma;
    EXPECT_NEAR(found.points[0].pt.y, 80.6, 0.15) << sigma;
    // Differences of Gaussians of sigma and k sigma answer most to a spot of about their mean.
    EXPECT_NEAR(found.points[0].size / (2.0 * sigma), 0.9, 0.12) << sigma;
  }
}

TEST(UprightFeatures, tellHowMuchASpotHasGrown)
{
  const UprightFeatures small = uprightFeatures(spots({{300.0, 80.0, 3.0}}), kContrast, 1);
  const UprightFeatures large = uprightFeatures(spots({{300.0, 80.0, 4.2}}), kContrast, 1);
  ASSERT_EQ(small.points.size() + large.points.size(), 2U);
  EXPECT_NEAR(large.points[0].size / small.points[0].size, 1.4, 0.05);
}

TEST(UprightFeatures, areFoundOnTheSeamOnce)
{
  const UprightFeatures found =
      uprightFeatures(spots({{719.6, 80.0, 4.0}, {300.0, 60.0, 4.0}}), kContrast, 10);
  ASSERT_EQ(found.points.size(), 2U);
  EXPECT_LT(found.points[0].pt.y, found.points[1].pt.y) << "from top to bottom";
  EXPECT_NEAR(std::remainder(found.points[1].pt.x - 719.6, 720.0), 0.0, 0.15);
  EXPECT_LT(cv::norm(found.descriptors.row(0), found.descriptors.row(1), cv::NORM_L1), 100.0);
}

TEST(UprightFeatures, keepTheStrongest)
{
  const SyntheticRoom room(5, 8.0, 6.0);
  const cv::Mat view = room.view({}).image;
  const UprightFeatures all = uprightFeatures(view, kContrast, 100000);
  const UprightFeatures few = uprightFeatures(view, kContrast, 50);
  ASSERT_GT(all.points.size(), 100U);
  ASSERT_EQ(few.points.size(), 50U);
  EXPECT_EQ(few.descriptors.rows, 50);
  std::vector<float> responses;
  for (const cv::KeyPoint &point : all.points) {
    responses.push_back(point.response);
  }
  std::sort(responses.rbegin(), responses.rend());
  for (const cv::KeyPoint &point : few.points) {
    EXPECT_GE(point.response, responses[49]);
  }
}

TEST(UprightFeatures, blankPicturesHaveNone)
{
  for (const int gray : {0, 128, 255}) {
    const UprightFeatures found =
        uprightFeatures(cv::Mat(160, 720, CV_8U, cv::Scalar(gray)), kContrast, 10);
    EXPECT_TRUE(found.points.empty());
    EXPECT_EQ(found.descriptors.rows, 0);
  }
}

TEST(UprightFeatures, matchThoseOfATurnedRobot)
{
  const SyntheticRoom room(5, 8.0, 6.0);
  const ScaleSpaceHoming method;
  const double turn = radians(73.0);
  const ScaleSpaceView home = method.prepare(room.view({0.3, 0.1, 0.0}));
  const ScaleSpaceView turned = method.prepare(room.view({0.3, 0.1, turn}));
  const std::vector<cv::DMatch> matches = matchKeypoints(turned, home, 0.8);
  ASSERT_GT(matches.size(), 100U);
  std::size_t right = 0;
  for (const cv::DMatch &match : matches) {
    const cv::KeyPoint &now = turned.points[static_cast<std::size_t>(match.queryIdx)];
    const cv::KeyPoint &then = home.points[static_cast<std::size_t>(match.trainIdx)];
    const double error =
        wrapAngle(home.geometry.azimuth(then.pt.x) - turn - turned.geometry.azimuth(now.pt.x));
    right += std::abs(error) < radians(0.5) && std::abs(then.pt.y - now.pt.y) < 1.0F ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(right), 0.95 * static_cast<double>(matches.size()));
}

} // namespace
} // namespace homeward
