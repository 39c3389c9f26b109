// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/core/angle.h>
#include <homeward/homing/visual_compass.h>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdlib>

namespace homeward
{
namespace
{

/** A real panorama of high dynamic range, all round and from pole to pole. */
cv::Mat readPanorama(const std::string &name)
{
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);
  cv::Mat linear = cv::imread((outsideDataDir() / "panoramas" / name).string(),
                              cv::IMREAD_ANYDEPTH | cv::IMREAD_COLOR);
  if (!linear.empty()) {
    cv::cvtColor(linear, linear, cv::COLOR_BGR2GRAY);
  }
  return linear;
}

/** What a camera shows of it that is turned left and exposed by so many stops more. */
Panorama expose(const cv::Mat &linear, double turn, double stops)
{
  const PanoramaGeometry geometry;
  cv::Mat u(geometry.height, geometry.width, CV_32F);
  cv::Mat v(geometry.height, geometry.width, CV_32F);
  for (int row = 0; row < geometry.height; ++row) {
    for (int column = 0; column < geometry.width; ++column) {
      const double azimuth = wrapAngle(geometry.azimuth(column) + turn);
      u.at<float>(row, column) =
          static_cast<float>((kPi - azimuth) / (2.0 * kPi) * linear.cols - 0.5);
      v.at<float>(row, column) =
          static_cast<float>((kPi / 2.0 - geometry.elevation(row)) / kPi * linear.rows - 0.5);
    }
  }
  cv::Mat seen;
  cv::remap(linear, seen, u, v, cv::INTER_LINEAR, cv::BORDER_WRAP);
  const double middle = cv::mean(linear)[0];
  seen *= std::pow(2.0, stops) * 0.18 / middle;
  cv::Mat coded;
  cv::pow(cv::max(seen, 0.0), 1.0 / 2.2, coded);
  Panorama panorama{{}, geometry};
  coded.convertTo(panorama.image, CV_8U, 255.0); // what is too bright saturates
  return panorama;
}

class RealPanoramas : public testing::TestWithParam<const char *>
{};

TEST_P(RealPanoramas, TurnsAreReadAtAnyExposure)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("panoramas/" + std::string(GetParam()));
  const cv::Mat linear = readPanorama(GetParam());
  ASSERT_FALSE(linear.empty());
  const Panorama home = expose(linear, 0.0, 0.0);
  double worst = 0.0;
  for (const double stops : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    for (const double turn : {0.0, 7.3, 45.2, 133.7, -90.4, 179.9}) {
      const auto reading = visualCompass(expose(linear, radians(turn), stops), home);
      ASSERT_TRUE(reading);
      worst = std::max(worst, std::abs(degrees(wrapAngle(reading->headingChange - radians(turn)))));
    }
  }
  EXPECT_LT(worst, 0.5);
  RecordProperty("worst_error_deg", std::to_string(worst));
  std::printf("%s: worst error %.2f degrees\n", GetParam(), worst);
}

INSTANTIATE_TEST_SUITE_P(Files, RealPanoramas,
                         testing::Values("apartment.exr", "lab.exr", "lobby.exr", "warehouse.exr"));

} // namespace
} // namespace homeward
