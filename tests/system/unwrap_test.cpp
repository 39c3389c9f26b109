// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "test_paths.h"

#include <homeward/camera/panorama.h>
#include <homeward/core/angle.h>
#include <homeward/core/pose2.h>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>

namespace homeward
{
namespace
{

/** Pixels as purple as the laboratory's rug; the first channel is blue. */
bool isPurple(const cv::Vec3b &pixel)
{
  return pixel[0] > pixel[1] + 40 && pixel[2] > pixel[1] + 20;
}

TEST(Unwrap, ShowsWhatStandsWhere)
{
  // Taken at (1, -2), heading 0.5; a purple rug lies on the floor from (0.7, -1.6) to (2.4, 0.8).
  const Folder folder;
  const std::string output = folder / "panorama.png";
  const ProgramRun run =
      runProgram("unwrap " + (dataDir() / "samples/mirror.jpg").string() + " --camera " +
                 (dataDir() / "cameras/sim_nominal.yaml").string() + " -o " + output);
  ASSERT_EQ(run.status, 0) << run.output;
  const cv::Mat picture = cv::imread(output);
  const PanoramaGeometry geometry;
  ASSERT_EQ(picture.cols, geometry.width);
  ASSERT_EQ(picture.rows, geometry.height);
  const Pose2 rMw = Pose2{1.0, -2.0, 0.5}.inverse();
  const Eigen::Vector2d rightCorner = rMw * Eigen::Vector2d(2.4, -1.6);
  double rightmost = kPi;
  int purple = 0;
  int belowHorizon = 0;
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      if (isPurple(picture.at<cv::Vec3b>(v, u))) {
        ++purple;
        belowHorizon += geometry.elevation(v) < radians(-10.0) ? 1 : 0;
        if (geometry.elevation(v) < radians(-10.0)) {
          rightmost = std::min(rightmost, geometry.azimuth(u));
        }
      }
    }
  }
  EXPECT_GT(purple, 2000);
  EXPECT_GT(belowHorizon, 0.9 * purple);
  const double bearing = std::atan2(rightCorner.y(), rightCorner.x());
  EXPECT_NEAR(degrees(rightmost), degrees(bearing), 3.0);
}

TEST(Unwrap, TakesARealPicture)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/example.jpg");
  const std::filesystem::path real = outsideDataDir() / "mirror/example.jpg";
  const Folder folder;
  const std::string output = folder / "panorama.png";
  const ProgramRun run =
      runProgram("unwrap " + real.string() + " --camera " +
                 (dataDir() / "cameras/example_mirror.yaml").string() + " -o " + output);
  ASSERT_EQ(run.status, 0) << run.output;
  const cv::Mat picture = cv::imread(output, cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(picture.empty());
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(picture, mean, deviation);
  EXPECT_GT(deviation[0], 20.0) << "a picture of nothing";
}

} // namespace
} // namespace homeward
