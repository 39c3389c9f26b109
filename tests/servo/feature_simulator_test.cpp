// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_task.h"
#include "test_paths.h"

#include <homeward/camera/unwarper.h>
#include <homeward/servo/feature_spherical_bearings.h>
#include <homeward/servo/feature_spherical_photometric.h>
#include <homeward/servo/photometric_offset.h>
#include <homeward/sim/simulator.h>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace homeward
{
namespace
{

/** About what walls and tables are away here, metres. */
constexpr double kRange = 4.0;

std::string textOf(const std::filesystem::path &path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/** Sees the laboratory through a simulated mirror that is a little off its camera file. */
class FeatureInTheLaboratory : public testing::Test
{
protected:
  /** What is seen from hMp; heights above the floor and planar motion as of the robot. */
  Panorama look(const Pose2 &hMp)
  {
    m_pioneer.kidnap(m_wMh * hMp);
    cv::Mat gray;
    cv::cvtColor(m_pioneer.camera().grab()->image, gray, cv::COLOR_BGR2GRAY);
    return m_unwarper.unwarp(gray);
  }

  PhotometricOptions options() const
  {
    PhotometricOptions options;
    options.range = kRange;
    options.cameraHeight = m_robot.rMp.translation().z();
    return options;
  }

  FeatureSphericalPhotometric photometric(const Pose2 &hMp)
  {
    FeatureSphericalPhotometric feature({}, options(), m_unwarper.visible());
    feature.buildFrom(look(hMp));
    return feature;
  }

  const Pose2 m_wMh{0.0, 0.0, 0.4};
  const RobotDescription m_robot =
      parseRobotDescription(textOf(dataDir() / "robots/pioneer3at.urdf"), "pioneer3at.urdf");
  const MirrorCamera m_nominal =
      parseMirrorCamera(textOf(dataDir() / "cameras/sim_nominal.yaml"), "sim_nominal.yaml");
  const Unwarper m_unwarper{m_nominal, PanoramaGeometry{}};
  Simulator m_pioneer{
      std::make_shared<const Scene>(loadScene((dataDir() / "worlds/lab.sdf").string())), m_robot,
      m_nominal, SimulatorOptions{}};
};

/** Bearings in two pictures of corners of the first, followed by optical flow. */
struct Tracked
{
  std::vector<SphericalBearing> home;
  std::vector<SphericalBearing> now;
};

Tracked track(const Panorama &home, const Panorama &now, double range)
{
  constexpr int kSeam = 60; // columns
  const auto wide = [](const Panorama &panorama) {
    cv::Mat picture;
    cv::copyMakeBorder(panorama.image, picture, 0, 0, kSeam, kSeam, cv::BORDER_WRAP);
    return picture;
  };
  cv::Mat mask = cv::Mat::zeros(home.image.rows, home.image.cols + 2 * kSeam, CV_8UC1);
  mask(cv::Rect(kSeam, 8, home.image.cols, home.image.rows - 16)) = 255;
  std::vector<cv::Point2f> before;
  cv::goodFeaturesToTrack(wide(home), before, 120, 0.01, 8.0, mask);
  std::vector<cv::Point2f> after;
  std::vector<cv::Point2f> again;
  std::vector<std::uint8_t> found;
  std::vector<std::uint8_t> foundAgain;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(wide(home), wide(now), before, after, found, error, {21, 21}, 4);
  cv::calcOpticalFlowPyrLK(wide(now), wide(home), after, again, foundAgain, error, {21, 21}, 4);
  const auto bearing = [&](const cv::Point2f &point) {
    const double azimuth = home.geometry.azimuth(point.x - kSeam);
    const double elevation = home.geometry.elevation(point.y);
    return SphericalBearing{{std::cos(elevation) * std::cos(azimuth),
                             std::cos(elevation) * std::sin(azimuth), std::sin(elevation)},
                            range};
  };
  Tracked tracked;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const cv::Point2f off = again[i] - before[i];
    if (found[i] != 0 && foundAgain[i] != 0 && std::hypot(off.x, off.y) < 0.5F) {
      tracked.home.push_back(bearing(before[i]));
      tracked.now.push_back(bearing(after[i]));
    }
  }
  return tracked;
}

vpColVector twistOf(const Pose2 &motion)
{
  vpColVector twist(6);
  twist[0] = motion.x;
  twist[1] = motion.y;
  twist[5] = motion.heading;
  return twist;
}

/** How what was seen goes with what was predicted. */
struct Agreement
{
  Agreement(const vpColVector &seen, const vpColVector &predicted)
      : slope(seen.t() * predicted / predicted.sumSquare()),
        correlation(seen.t() * predicted / std::sqrt(seen.sumSquare() * predicted.sumSquare()))
  {}

  double slope;
  double correlation;
};

const std::vector<Pose2> &motions()
{
  static const std::vector<Pose2> motions{{0.03, 0.0, 0.0},
                                          {0.0, 0.03, 0.0},
                                          {-0.02, 0.02, 0.0},
                                          {0.0, 0.0, radians(2.0)},
                                          {0.0, 0.0, radians(-2.0)}};
  return motions;
}

TEST_F(FeatureInTheLaboratory, photometricChangesAreThoseOfTheMotion)
{
  FeatureSphericalPhotometric home = photometric({});
  for (const Pose2 &motion : motions()) {
    FeatureSphericalPhotometric moved = photometric(motion);
    const vpMatrix mean = (home.interaction() + moved.interaction()) * 0.5;
    const Agreement agreement(moved.error(home), mean * twistOf(motion));
    EXPECT_NEAR(agreement.slope, 1.0, motion.heading != 0.0 ? 0.05 : 0.3);
    EXPECT_GT(agreement.correlation, motion.heading != 0.0 ? 0.98 : 0.8);
  }
}

TEST_F(FeatureInTheLaboratory, bearingsOfCornersChangeAsTheMotionSays)
{
  const Panorama home = look({});
  for (const Pose2 &motion : motions()) {
    const Tracked tracked = track(home, look(motion), kRange);
    ASSERT_GT(tracked.home.size(), 30U);
    FeatureSphericalBearings before;
    FeatureSphericalBearings after;
    before.set(tracked.home);
    after.set(tracked.now);
    const Agreement agreement(after.error(before), before.interaction() * twistOf(motion));
    EXPECT_NEAR(agreement.slope, 1.0, motion.heading != 0.0 ? 0.05 : 0.3);
    EXPECT_GT(agreement.correlation, motion.heading != 0.0 ? 0.98 : 0.8);
  }
}

TEST_F(FeatureInTheLaboratory, photometricTaskComesHome)
{
  FeatureSphericalPhotometric wanted = photometric({});
  FeatureSphericalPhotometric now = wanted;
  for (const Pose2 &start : {Pose2{0.15, 0.0, radians(10.0)}, Pose2{-0.09, 0.12, radians(-10.0)}}) {
    const Pose2 end =
        flyHome(now, wanted, start, 30, [&](const Pose2 &hMp) { now.buildFrom(look(hMp)); });
    EXPECT_LT(end.translation().norm(), 0.01);
    EXPECT_LT(std::abs(degrees(end.heading)), 0.3);
  }
}

TEST_F(FeatureInTheLaboratory, bearingsTaskComesHomeWithRoughRanges)
{
  const Panorama home = look({});
  for (const double range : {0.5 * kRange, 2.0 * kRange}) {
    FeatureSphericalBearings wanted;
    FeatureSphericalBearings now;
    const Pose2 end = flyHome(now, wanted, {0.09, -0.12, radians(10.0)}, 40, [&](const Pose2 &hMp) {
      const Tracked tracked = track(home, look(hMp), range);
      wanted.set(tracked.home);
      now.set(tracked.now);
    });
    EXPECT_LT(end.translation().norm(), 0.01) << range;
    EXPECT_LT(std::abs(degrees(end.heading)), 0.3) << range;
  }
}

TEST_F(FeatureInTheLaboratory, photometricOffsetIsThatOfTheMotion)
{
  PhotometricOffsetOptions offsetOptions;
  offsetOptions.sphere.range = kRange;
  offsetOptions.sphere.cameraHeight = m_robot.rMp.translation().z();
  const Panorama home = look({});
  for (const Pose2 &hMp : {Pose2{0.05, 0.0, radians(3.0)}, Pose2{-0.02, 0.03, radians(-2.0)},
                           Pose2{0.0, -0.01, radians(0.5)}}) {
    const auto found = photometricOffset(look(hMp), home, offsetOptions, m_unwarper.visible());
    ASSERT_TRUE(found);
    const double off = (found->hMp.translation() - hMp.translation()).norm();
    EXPECT_LT(off, 0.3 * hMp.translation().norm() + 0.002);
    EXPECT_LT(std::abs(degrees(found->hMp.heading - hMp.heading)), 0.3);
  }
}

} // namespace
} // namespace homeward
