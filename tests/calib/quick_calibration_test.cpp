// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/calib/quick_calibration.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace homeward
{
namespace
{

cv::Mat sample()
{
  return cv::imread((dataDir() / "samples/mirror.jpg").string());
}

/** Angle from the axis that the camera shows at a radius, degrees. */
double angleAt(const UnifiedCamera &camera, double radius)
{
  const auto &p = camera.parameters();
  const auto ray = camera.unproject({p.cx + radius, p.cy});
  return ray ? degrees(std::acos(ray->z())) : 180.0;
}

// The simulated mirror: xi 0.95, f 108 px up to 0.5 % off, the centre up to 3 px off 319.5, 239.5.
TEST(QuickCalibration, findsTheSimulatorsMirror)
{
  const QuickCalibration quick = calibrateFromScene({sample()});
  const UnifiedCamera truth({0.95, 108, 108, 319.5, 239.5, 0, 0, 0, 0}, 640, 480);
  EXPECT_NEAR(quick.camera.parameters().cx, 319.5, 3.5);
  EXPECT_NEAR(quick.camera.parameters().cy, 239.5, 3.5);
  for (const double radius : {60.0, 120.0, 180.0, 230.0}) {
    EXPECT_NEAR(angleAt(quick.camera, radius), angleAt(truth, radius), 1.5) << radius << " px";
  }
  EXPECT_GT(quick.lines, 20);
  EXPECT_LT(quick.bendPx, 0.6);
}

TEST(QuickCalibration, takesTheSheetAtItsWord)
{
  const QuickCalibration quick = calibrateFromScene({sample()}, {0.9, radians(30.0)});
  EXPECT_DOUBLE_EQ(quick.camera.parameters().xi, 0.9);
  EXPECT_NEAR(angleAt(quick.camera, quick.mirror.outer.radius), 120.0, 1e-6);
  EXPECT_THAT(quick.assumed, testing::Contains(testing::HasSubstr("xi 0.90 as given")));
  EXPECT_THAT(quick.assumed, testing::Contains(testing::HasSubstr("30.00 degrees above")));
}

// The centre and the horizon's radius (443 px) are the OCamCalib file's that came with the picture.
TEST(QuickCalibration, straightensTheRealPicture)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/example.jpg");
  const cv::Mat picture = cv::imread((outsideDataDir() / "mirror/example.jpg").string());
  const QuickCalibration quick = calibrateFromScene({picture});
  EXPECT_NEAR(quick.camera.parameters().cx, 980.7, 5.0);
  EXPECT_NEAR(quick.camera.parameters().cy, 555.4, 5.0);
  EXPECT_NEAR(angleAt(quick.camera, 443.0), 90.0, 2.0);
  EXPECT_GT(quick.lines, 40);
  EXPECT_THAT(quick.assumed, testing::Contains(testing::HasSubstr("hardly tell")));
}

TEST(QuickCalibration, seesTheSameInASmallPicture)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/example.jpg");
  const cv::Mat picture = cv::imread((outsideDataDir() / "mirror/example.jpg").string());
  cv::Mat small;
  constexpr double kTimes = 8.0;
  cv::resize(picture, small, {}, 1.0 / kTimes, 1.0 / kTimes, cv::INTER_AREA);
  const auto large = calibrateFromScene({picture}, {}).camera.parameters();
  const auto little = calibrateFromScene({small}, {}).camera.parameters();
  EXPECT_NEAR(kTimes * little.fx, large.fx, 0.05 * large.fx);
  EXPECT_NEAR(little.cx, large.cx / kTimes, 2.0);
  EXPECT_EQ(calibrateFromScene({small}, {}).camera.width(), small.cols);
}

TEST(QuickCalibration, saysWhenThereIsNothingToGoBy)
{
  EXPECT_THROW(calibrateFromScene({}), ConfigError);
  EXPECT_THROW(calibrateFromScene({cv::Mat1b(480, 640, uchar{90})}), ConfigError);
  EXPECT_THROW(calibrateFromScene({sample(), cv::Mat1b(48, 64, uchar{90})}), ConfigError);
  EXPECT_THROW(calibrateFromScene({sample()}, {9.0, {}}), ConfigError);
}

} // namespace
} // namespace homeward
