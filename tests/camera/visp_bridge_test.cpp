// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/visp_bridge.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace homeward
{
namespace
{

TEST(VispBridge, MotionsGoThereAndBack)
{
  Eigen::Isometry3d aMb = Eigen::Translation3d(1.0, -2.0, 0.9) *
                          Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  EXPECT_TRUE(fromVisp(toVisp(aMb)).isApprox(aMb, 1e-14));
  EXPECT_EQ(toVisp(aMb)[0][3], 1.0);
}

TEST(VispBridge, PicturesKeepTheirPixels)
{
  cv::Mat gray(3, 4, CV_8UC1);
  cv::randu(gray, 0, 256);
  const vpImage<unsigned char> there = toVispGray(gray);
  EXPECT_EQ(there[1][2], gray.at<uchar>(1, 2));
  EXPECT_EQ(cv::norm(fromVisp(there), gray, cv::NORM_INF), 0.0);
  EXPECT_THROW(toVispGray(cv::Mat(3, 4, CV_8UC3)), LogicError);

  vpImage<vpRGBa> colour(2, 2, vpRGBa(10, 20, 30));
  EXPECT_EQ(fromVisp(colour).at<cv::Vec3b>(0, 0), cv::Vec3b(30, 20, 10));

  cv::Mat bgr(3, 4, CV_8UC3);
  cv::randu(bgr, 0, 256);
  const vpImage<vpRGBa> copied = toVispColour(bgr);
  EXPECT_EQ(copied[2][1].R, bgr.at<cv::Vec3b>(2, 1)[2]);
  EXPECT_EQ(copied[2][1].A, 255);
  EXPECT_EQ(cv::norm(fromVisp(copied), bgr, cv::NORM_INF), 0.0);
  EXPECT_THROW(toVispColour(gray), LogicError);
}

} // namespace
} // namespace homeward
