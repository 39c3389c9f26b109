// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/unwarper.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

MirrorCamera nominal(bool leftIsClockwise, double forward)
{
  return {UnifiedCamera({0.95, 108, 108, 319.5, 239.5, 0, 0, 0, 0}, 640, 480),
          {30.0, 236.0},
          {forward, leftIsClockwise}};
}

/** Azimuth in the robot's frame that every pixel shows; NaN where it shows none. */
cv::Mat1d azimuths(const MirrorCamera &camera)
{
  cv::Mat1d result(480, 640, std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v < result.rows; ++v) {
    for (int u = 0; u < result.cols; ++u) {
      if (const auto ray = camera.model.unproject({u, v})) {
        const double angle = std::atan2(ray->y(), ray->x()) - camera.mount.forward;
        result(v, u) = wrapAngle(camera.mount.leftIsClockwise ? angle : -angle);
      }
    }
  }
  return result;
}

/** A mirror picture whose brightness is a function of the azimuth. */
template <class Brightness> cv::Mat draw(const cv::Mat1d &azimuths, Brightness brightness)
{
  cv::Mat1b picture(azimuths.size(), 0);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      if (!std::isnan(azimuths(v, u))) {
        picture(v, u) = cv::saturate_cast<uchar>(brightness(azimuths(v, u)));
      }
    }
  }
  return picture;
}

/** Bright where the landmark at `bearing` stands, 0.3 rad wide. */
auto landmark(double bearing)
{
  return [bearing](double azimuth) {
    const double aside = wrapAngle(azimuth - bearing) / 0.15;
    return 255.0 * std::exp(-aside * aside);
  };
}

/** Column of the brightest spot on the horizon. */
int brightest(const Panorama &panorama)
{
  cv::Point where;
  const int horizon = static_cast<int>(panorama.geometry.row(0.0));
  cv::minMaxLoc(panorama.image.row(horizon), nullptr, nullptr, nullptr, &where);
  return where.x;
}

class UnwarperLaw : public testing::TestWithParam<std::tuple<bool, double>>
{
protected:
  MirrorCamera camera = nominal(std::get<0>(GetParam()), std::get<1>(GetParam()));
  Unwarper unwarper{camera, PanoramaGeometry{}};
  cv::Mat1d shown = azimuths(camera);
};

TEST_P(UnwarperLaw, LeftIsLeftAndForwardIsInTheMiddle)
{
  EXPECT_NEAR(brightest(unwarper.unwarp(draw(shown, landmark(0.0)))), 360, 4);
  EXPECT_NEAR(brightest(unwarper.unwarp(draw(shown, landmark(kPi / 2)))), 180, 4);
  EXPECT_NEAR(brightest(unwarper.unwarp(draw(shown, landmark(-kPi / 2)))), 540, 4);
}

TEST_P(UnwarperLaw, LeftTurnMovesLandmarksRight)
{
  const double turn = radians(40.0);
  const int before = brightest(unwarper.unwarp(draw(shown, landmark(0.2))));
  const int after = brightest(unwarper.unwarp(draw(shown, landmark(0.2 - turn))));
  EXPECT_NEAR(after - before, turn * 720 / (2 * kPi), 4);
}

INSTANTIATE_TEST_SUITE_P(Mounts, UnwarperLaw,
                         testing::Combine(testing::Bool(),
                                          testing::Values(-kPi / 2, 0.0, radians(77.0))));

TEST(Unwarper, KeepsChannelsAndMasksTheBlindPart)
{
  const MirrorCamera camera = nominal(true, 0.0);
  PanoramaGeometry geometry;
  geometry.elevationMin = radians(-85.0); // the camera hides what lies so low
  const Unwarper unwarper(camera, geometry);
  const Panorama colour = unwarper.unwarp(cv::Mat(480, 640, CV_8UC3, cv::Scalar(10, 20, 30)));
  EXPECT_EQ(colour.image.type(), CV_8UC3);
  EXPECT_EQ(colour.image.at<cv::Vec3b>(60, 100), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(colour.image.at<cv::Vec3b>(159, 100), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(unwarper.visible().at<uchar>(159, 100), 0);
  EXPECT_EQ(unwarper.visible().at<uchar>(60, 100), 255);
}

TEST(Unwarper, RefusesAnotherSize)
{
  const Unwarper unwarper(nominal(true, 0.0), PanoramaGeometry{});
  EXPECT_THROW(unwarper.unwarp(cv::Mat(480, 641, CV_8UC1)), LogicError);
  EXPECT_THROW(unwarper.unwarp(cv::Mat(480, 640, CV_32FC1)), LogicError);
}

TEST(Unwarper, RefusesAGeometryWithoutPixels)
{
  PanoramaGeometry geometry;
  geometry.height = 0;
  EXPECT_THROW(Unwarper(nominal(true, 0.0), geometry), LogicError);
  geometry.height = 160;
  geometry.elevationMin = geometry.elevationMax;
  EXPECT_THROW(Unwarper(nominal(true, 0.0), geometry), LogicError);
}

TEST(PanoramaGeometry, ColumnInvertsAzimuthAndRowInvertsElevation)
{
  const PanoramaGeometry geometry;
  for (double u = -0.5; u < 719.4; u += 7.3) {
    EXPECT_NEAR(geometry.column(geometry.azimuth(u)), u, 1e-9);
  }
  for (double v = 0.0; v < 160.0; v += 3.7) {
    EXPECT_NEAR(geometry.row(geometry.elevation(v)), v, 1e-9);
  }
  EXPECT_NEAR(geometry.azimuth(359.5), 0.0, 1e-12);
  EXPECT_GT(geometry.azimuth(0), geometry.azimuth(1));
}

} // namespace
} // namespace homeward
