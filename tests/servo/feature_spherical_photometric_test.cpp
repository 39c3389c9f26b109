// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_task.h"
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/servo/feature_spherical_photometric.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace homeward
{
namespace
{

constexpr double kEye = 0.9; ///< metres, of SyntheticRoom

PhotometricOptions withHeight(double range)
{
  PhotometricOptions options;
  options.range = range;
  options.cameraHeight = kEye;
  return options;
}

double dot(const vpColVector &a, const vpColVector &b)
{
  return (a.t() * b);
}

struct Change
{
  vpColVector seen;
  vpColVector predicted;

  /** Seen over predicted, in the predicted direction. */
  double slope() const { return dot(seen, predicted) / dot(predicted, predicted); }

  double correlation() const
  {
    return dot(seen, predicted) / (seen.frobeniusNorm() * predicted.frobeniusNorm());
  }
};

/** From -motion to +motion about the middle, whose L predicts. */
Change across(const SyntheticRoom &room, const PanoramaGeometry &geometry,
              const PhotometricOptions &options, const Pose2 &motion)
{
  FeatureSphericalPhotometric before(geometry, options);
  FeatureSphericalPhotometric middle(geometry, options);
  FeatureSphericalPhotometric after(geometry, options);
  before.buildFrom(room.view({-motion.x, -motion.y, -motion.heading}, {}, geometry));
  middle.buildFrom(room.view({}, {}, geometry));
  after.buildFrom(room.view(motion, {}, geometry));
  vpColVector twist(6);
  twist[0] = 2.0 * motion.x;
  twist[1] = 2.0 * motion.y;
  twist[5] = 2.0 * motion.heading;
  return {after.error(before), middle.interaction() * twist};
}

TEST(FeatureSphericalPhotometric, interactionIsTheDerivativeOfATurn)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const Change change = across(room, {}, withHeight(2.0), {0.0, 0.0, radians(0.5)});
  EXPECT_NEAR(change.slope(), 1.0, 0.02);
  EXPECT_GT(change.correlation(), 0.995);
}

TEST(FeatureSphericalPhotometric, interactionIsTheDerivativeOfAMoveWhereTheRangeIsKnown)
{
  // Down to -65 and up to -25 degrees a room of 20 m shows nothing but its floor.
  PanoramaGeometry floor;
  floor.elevationMin = radians(-65.0);
  floor.elevationMax = radians(-25.0);
  const SyntheticRoom room(31, 20.0, 20.0);
  for (const Pose2 &motion :
       {Pose2{0.01, 0.0, 0.0}, Pose2{0.0, 0.01, 0.0}, Pose2{-0.006, 0.008, radians(0.4)}}) {
    const Change change = across(room, floor, withHeight(20.0), motion);
    EXPECT_NEAR(change.slope(), 1.0, 0.02) << motion.x << " " << motion.y;
    EXPECT_GT(change.correlation(), 0.995) << motion.x << " " << motion.y;
  }
}

TEST(FeatureSphericalPhotometric, aRoughRangeStillTellsTheWay)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  for (const Pose2 &motion : {Pose2{0.01, 0.0, 0.0}, Pose2{0.0, 0.01, 0.0}}) {
    const Change change = across(room, {}, withHeight(2.5), motion);
    EXPECT_NEAR(change.slope(), 1.0, 0.25);
    EXPECT_GT(change.correlation(), 0.9);
  }
}

/** A turn about x or y, which the planar room cannot make: every pixel looks up a smooth sphere. */
Panorama smoothSphere(const PanoramaGeometry &geometry, const Eigen::Matrix3d &wRp)
{
  Panorama panorama{cv::Mat(geometry.height, geometry.width, CV_8UC1), geometry};
  for (int v = 0; v < geometry.height; ++v) {
    for (int u = 0; u < geometry.width; ++u) {
      const double elevation = geometry.elevation(v);
      const double azimuth = geometry.azimuth(u);
      const Eigen::Vector3d look =
          wRp * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double level = 128.0 + 50.0 * std::sin(5.0 * look.x() + 2.0 * look.z()) +
                           50.0 * std::cos(4.0 * look.y() - 6.0 * look.z() + 0.5);
      panorama.image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(level);
    }
  }
  return panorama;
}

TEST(FeatureSphericalPhotometric, interactionIsTheDerivativeOfTurnsAboutEveryAxis)
{
  const PanoramaGeometry geometry;
  const double step = radians(1.0);
  for (unsigned int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d about = Eigen::Vector3d::Unit(axis);
    const auto turned = [&](double angle) {
      FeatureSphericalPhotometric feature(geometry);
      feature.buildFrom(smoothSphere(geometry, Eigen::AngleAxisd(angle, about).toRotationMatrix()));
      return feature;
    };
    vpColVector twist(6);
    twist[3 + axis] = 2.0 * step;
    FeatureSphericalPhotometric after = turned(step);
    const Change change{after.error(turned(-step)), turned(0.0).interaction() * twist};
    EXPECT_LT((change.seen - change.predicted).frobeniusNorm(),
              0.01 * change.predicted.frobeniusNorm())
        << "axis " << axis;
  }
}

TEST(FeatureSphericalPhotometric, aTurnByACellMovesEveryCellByOneRoundTheSeam)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const auto columns = static_cast<unsigned int>(PhotometricOptions{}.columns);
  FeatureSphericalPhotometric before;
  FeatureSphericalPhotometric turned;
  ASSERT_TRUE(before.buildFrom(room.view({0.0, 0.0, 0.3})));
  ASSERT_TRUE(turned.buildFrom(room.view({0.0, 0.0, 0.3 + 2.0 * kPi / columns})));
  const vpMatrix L = before.interaction();
  const vpMatrix turnedL = turned.interaction();
  for (unsigned int i = 0; i < L.getRows(); ++i) {
    const unsigned int right = i % columns + 1 < columns ? i + 1 : i + 1 - columns;
    EXPECT_NEAR(turned[right], before[i], 1e-5) << "cell " << i;
    EXPECT_NEAR(turnedL[right][5], L[i][5], 1e-4) << "cell " << i;
  }
}

TEST(FeatureSphericalPhotometric, exposureDoesNotMatter)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  FeatureSphericalPhotometric bright;
  FeatureSphericalPhotometric dim;
  ASSERT_TRUE(bright.buildFrom(room.view({})));
  ASSERT_TRUE(dim.buildFrom(room.view({}, {0.5, 30.0, 0.0, 0.0})));
  EXPECT_LT(bright.error(dim).frobeniusNorm(), 0.01);
  EXPECT_NEAR(dot(bright.get_s(), bright.get_s()), 1.0, 1e-6);
  const vpMatrix difference = bright.interaction() - dim.interaction();
  EXPECT_LT(difference.frobeniusNorm(), 0.02 * bright.interaction().frobeniusNorm());
}

TEST(FeatureSphericalPhotometric, whatIsHiddenDoesNotMatter)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const PanoramaGeometry geometry;
  cv::Mat visible(geometry.height, geometry.width, CV_8UC1, cv::Scalar(255));
  visible(cv::Rect(300, 90, 120, 70)) = 0;
  Panorama view = room.view({});
  FeatureSphericalPhotometric with(geometry, {}, visible);
  FeatureSphericalPhotometric without(geometry, {}, visible);
  with.buildFrom(view);
  view.image(cv::Rect(300, 90, 120, 70)) = 7;
  without.buildFrom(view);
  EXPECT_EQ(with.error(without).frobeniusNorm(), 0.0);
  const vpMatrix difference = with.interaction() - without.interaction();
  EXPECT_EQ(difference.frobeniusNorm(), 0.0);
}

struct LightCase
{
  std::string name;
  RoomLight light;
  double metres;
  double degrees;
};

class PhotometricFlight : public testing::TestWithParam<LightCase>
{};

TEST_P(PhotometricFlight, comesHomeFrom15CentimetresAnd10Degrees)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const Pose2 wMh{0.4, -0.3, 0.5};
  FeatureSphericalPhotometric now({}, withHeight(2.5));
  FeatureSphericalPhotometric wanted({}, withHeight(2.5));
  wanted.buildFrom(room.view(wMh));
  for (int start = 0; start < 4; ++start) {
    const double away = start * kPi / 2.0;
    const Pose2 end = flyHome(
        now, wanted,
        {0.15 * std::cos(away), 0.15 * std::sin(away), radians(start % 2 == 0 ? 10.0 : -10.0)}, 30,
        [&](const Pose2 &hMp) { now.buildFrom(room.view(wMh * hMp, GetParam().light)); });
    EXPECT_LT(end.translation().norm(), GetParam().metres) << "start " << start;
    EXPECT_LT(std::abs(degrees(end.heading)), GetParam().degrees) << "start " << start;
  }
}

INSTANTIATE_TEST_SUITE_P(Lights, PhotometricFlight,
                         testing::Values(LightCase{"same", {}, 0.01, 0.3},
                                         LightCase{"dimmer", {0.5, 10.0, 0.0, 0.0}, 0.01, 0.3}),
                         [](const auto &instance) { return instance.param.name; });

TEST(FeatureSphericalPhotometric, aBlackPictureMovesNothing)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  FeatureSphericalPhotometric now;
  FeatureSphericalPhotometric wanted;
  ASSERT_TRUE(wanted.buildFrom(room.view({})));
  ASSERT_TRUE(now.buildFrom(room.view({})));
  for (const double level : {0.0, 255.0}) {
    Panorama blank = room.view({});
    blank.image.setTo(level);
    EXPECT_FALSE(now.buildFrom(blank));
    EXPECT_EQ(now.interaction().frobeniusNorm(), 0.0);
    const Pose2 start{0.1, 0.0, 0.1};
    const Pose2 end = flyHome(now, wanted, start, 3, [](const Pose2 &) {});
    EXPECT_EQ(end.x, start.x);
    EXPECT_EQ(end.heading, start.heading);
  }
}

TEST(FeatureSphericalPhotometric, refusesBadInput)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const PanoramaGeometry geometry;
  FeatureSphericalPhotometric feature;
  feature.buildFrom(room.view({}));
  PanoramaGeometry small;
  small.width = 360;
  EXPECT_THROW(feature.buildFrom(room.view({}, {}, small)), LogicError);
  EXPECT_THROW(feature.buildFrom({cv::Mat(), geometry}), LogicError);
  EXPECT_THROW(feature.buildFrom({cv::Mat(80, 720, CV_8UC1), geometry}), LogicError);
  EXPECT_THROW(feature.buildFrom({cv::Mat(160, 720, CV_32FC1), geometry}), LogicError);
  EXPECT_NEAR(feature.get_s().frobeniusNorm(), 1.0, 1e-6) << "a refused picture changes nothing";

  PhotometricOptions options;
  options.columns = 36;
  FeatureSphericalPhotometric other(geometry, options);
  EXPECT_THROW(feature.error(other), LogicError);
  const auto refuses = [&](double PhotometricOptions::*option, double value) {
    PhotometricOptions bad;
    bad.*option = value;
    EXPECT_THROW(FeatureSphericalPhotometric(geometry, bad), LogicError) << value;
  };
  refuses(&PhotometricOptions::range, 0.0);
  refuses(&PhotometricOptions::range, std::nan(""));
  refuses(&PhotometricOptions::lowPass, -0.1);
  refuses(&PhotometricOptions::lowPass, std::nan(""));
  refuses(&PhotometricOptions::cameraHeight, -0.1);
  options.columns = 721;
  EXPECT_THROW(FeatureSphericalPhotometric(geometry, options), LogicError);
  EXPECT_THROW(FeatureSphericalPhotometric(geometry, {}, cv::Mat(3, 3, CV_8UC1)), LogicError);
}

TEST(FeatureSphericalPhotometric, duplicates)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  FeatureSphericalPhotometric feature;
  feature.buildFrom(room.view({}));
  const std::unique_ptr<vpBasicFeature> copy(feature.duplicate());
  EXPECT_EQ(feature.error(*copy).frobeniusNorm(), 0.0);
  const vpMatrix difference = feature.interaction() - copy->interaction();
  EXPECT_EQ(difference.frobeniusNorm(), 0.0);
}

} // namespace
} // namespace homeward
