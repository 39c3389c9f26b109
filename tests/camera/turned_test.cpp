// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/turned.h>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace homeward
{
namespace
{

/** A landmark as wide as a hand, round a given azimuth, brightest there. */
Panorama landmarkAt(double azimuth)
{
  constexpr double kWidth = radians(4.0);
  Panorama panorama{{}, PanoramaGeometry()};
  panorama.image.create(panorama.geometry.height, panorama.geometry.width, CV_8UC1);
  for (int u = 0; u < panorama.image.cols; ++u) {
    const double off = wrapAngle(panorama.geometry.azimuth(u) - azimuth) / kWidth;
    panorama.image.col(u).setTo(20.0 + 200.0 * std::exp(-off * off));
  }
  return panorama;
}

double largestDifference(const Panorama &a, const Panorama &b)
{
  return cv::norm(a.image, b.image, cv::NORM_INF);
}

TEST(Turned, whatIsAtAnAzimuthIsThenSoMuchToTheRight)
{
  for (const double turn : {radians(90.0), radians(-200.0), radians(0.17), radians(-3.1)}) {
    const Panorama view = turned(landmarkAt(2.5), turn);
    EXPECT_EQ(view.geometry, PanoramaGeometry());
    EXPECT_LE(largestDifference(view, landmarkAt(2.5 - turn)), 2.0) << turn;
    EXPECT_GE(largestDifference(view, landmarkAt(2.5 - turn + radians(0.1))), 3.0) << turn;
  }
}

TEST(Turned, byWholeColumnsNothingIsLost)
{
  cv::Mat noise(160, 720, CV_8UC3);
  cv::theRNG().state = 4;
  cv::randu(noise, 0, 256);
  const Panorama view{noise, PanoramaGeometry()};
  const Panorama there = turned(view, radians(37.5));
  EXPECT_GE(largestDifference(there, view), 100.0);
  EXPECT_EQ(largestDifference(turned(there, radians(-37.5)), view), 0.0);
  EXPECT_EQ(largestDifference(turned(view, 2.0 * kPi), view), 0.0);
}

} // namespace
} // namespace homeward
