// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract_room.h"
#include "device_contract.h"
#include "test_robot.h"

#include <homeward/camera/unwarper.h>

#include <algorithm>
#include <vector>

namespace homeward
{
namespace
{

/** Azimuth of the red post in a mirror picture, radians. */
double azimuthOfThePost(const cv::Mat &picture)
{
  const Panorama panorama = Unwarper(testCamera(), PanoramaGeometry{}).unwarp(picture);
  std::vector<double> redness(static_cast<std::size_t>(panorama.image.cols), 0.0);
  for (int row = 0; row < panorama.image.rows; ++row) {
    for (int column = 0; column < panorama.image.cols; ++column) {
      const auto &pixel = panorama.image.at<cv::Vec3b>(row, column);
      redness[static_cast<std::size_t>(column)] += std::max(0, pixel[2] - pixel[1] - 20);
    }
  }
  const double half = *std::max_element(redness.begin(), redness.end()) / 2.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t column = 0; column < redness.size(); ++column) {
    const double azimuth = panorama.geometry.azimuth(static_cast<double>(column));
    if (redness[column] > half) {
      sum += redness[column] * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
    }
  }
  return std::atan2(sum.y(), sum.x());
}

TEST_P(DeviceContract, landmarkOnTheLeftStandsLeftOfTheMiddleOfThePanorama)
{
  HOMEWARD_NEEDS_DEVICE(camera);
  const auto frame = robot->camera()->grab();
  ASSERT_TRUE(frame);
  const double azimuth = azimuthOfThePost(frame->image);
  EXPECT_NEAR(azimuth, radians(45.0), radians(3.0));
  const PanoramaGeometry geometry;
  EXPECT_LT(geometry.column(azimuth), geometry.width / 2.0);
}

TEST_P(DeviceContract, landmarkMovesRightByWhatTheRobotTurnsLeft)
{
  HOMEWARD_NEEDS_DEVICE(camera);
  HOMEWARD_NEEDS_DEVICE(base);
  const Pose2 before = robot->base()->state().odometry;
  const double azimuthBefore = azimuthOfThePost(robot->camera()->grab()->image);
  driveAndStop({0.0, 0.4}, 2.0);
  const Pose2 moved = before.inverse() * robot->base()->state().odometry;
  const double azimuthAfter = azimuthOfThePost(robot->camera()->grab()->image);
  EXPECT_GT(moved.heading, radians(30.0));
  EXPECT_NEAR(azimuthBefore - azimuthAfter, moved.heading, 0.1 * moved.heading + radians(1.0));
}

TEST_P(DeviceContract, picturesAreStampedWithAPastThatMovesOn)
{
  HOMEWARD_NEEDS_DEVICE(camera);
  const auto first = robot->camera()->grab();
  wait(0.5);
  const auto second = robot->camera()->grab();
  ASSERT_TRUE(first && second);
  EXPECT_GT(second->stamp, first->stamp);
  EXPECT_LE(second->stamp, robot->clock().now());
  EXPECT_EQ(second->image.size(), first->image.size());
}

} // namespace
} // namespace homeward
