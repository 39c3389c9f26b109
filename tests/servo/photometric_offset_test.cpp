// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/servo/photometric_offset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace homeward
{
namespace
{

PhotometricOffsetOptions floorKnown()
{
  PhotometricOffsetOptions options;
  options.sphere.range = 2.5;
  options.sphere.cameraHeight = 0.9;
  return options;
}

std::vector<Pose2> nearby(std::uint32_t stream, int count, double metres, double turn)
{
  Random random(23, stream);
  std::vector<Pose2> poses;
  for (int i = 0; i < count; ++i) {
    const double away = random.uniform(-kPi, kPi);
    const double distance = random.uniform(0.0, metres);
    poses.push_back(
        {distance * std::cos(away), distance * std::sin(away), random.uniform(-turn, turn)});
  }
  return poses;
}

struct OffsetCase
{
  std::string name;
  RoomLight light;
  double metres;  ///< of the offset, at most
  double turn;    ///< rad
  double share;   ///< of the distance that may be wrong
  double more;    ///< metres that may be wrong besides
  double degrees; ///< that may be wrong
};

class PhotometricOffsetOf : public testing::TestWithParam<OffsetCase>
{};

TEST_P(PhotometricOffsetOf, findsTheOffset)
{
  const OffsetCase &wanted = GetParam();
  const SyntheticRoom room(31, 6.0, 5.0);
  const Pose2 wMh{0.4, -0.3, 0.5};
  const Panorama stored = room.view(wMh);
  for (const Pose2 &hMp : nearby(1, 5, wanted.metres, wanted.turn)) {
    const auto found = photometricOffset(room.view(wMh * hMp, wanted.light), stored, floorKnown());
    ASSERT_TRUE(found) << hMp.x << " " << hMp.y << " " << hMp.heading;
    const double off = (found->hMp.translation() - hMp.translation()).norm();
    EXPECT_LT(off, wanted.share * hMp.translation().norm() + wanted.more);
    EXPECT_LT(std::abs(degrees(wrapAngle(found->hMp.heading - hMp.heading))), wanted.degrees);
    EXPECT_GT(found->covariance.determinant(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Offsets, PhotometricOffsetOf,
    testing::Values(
        OffsetCase{"centimetres", {}, 0.03, radians(3.0), 0.15, 0.001, 0.1},
        OffsetCase{"fromAfar", {}, 0.12, radians(8.0), 0.2, 0.002, 0.5},
        OffsetCase{"dimmer", {0.5, 10.0, 0.0, 0.0}, 0.03, radians(3.0), 0.15, 0.001, 0.1},
        OffsetCase{"otherLamp", {0.8, 0.0, 0.25, 1.0}, 0.03, radians(3.0), 0.2, 0.03, 1.0}),
    [](const auto &instance) { return instance.param.name; });

TEST(PhotometricOffset, fromTooFarItIsRightOrMissing)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const Panorama stored = room.view({});
  const PhotometricOffsetOptions options = floorKnown();
  for (const Pose2 &hMp : nearby(2, 20, 0.6, radians(30.0))) {
    const auto found = photometricOffset(room.view(hMp), stored, options);
    const double distance = hMp.translation().norm();
    if (distance < 0.9 * options.reach && std::abs(hMp.heading) < 0.9 * options.turn) {
      EXPECT_TRUE(found) << distance << " " << degrees(hMp.heading);
    }
    if (found) {
      const double off = (found->hMp.translation() - hMp.translation()).norm();
      EXPECT_LT(off, 0.2 * distance + 0.002) << distance << " " << degrees(hMp.heading);
    }
  }
}

TEST(PhotometricOffset, covarianceIsThatOfNoise)
{
  const Panorama stored = SyntheticRoom(31, 6.0, 5.0).view({});
  cv::RNG noise(5);
  double sum = 0.0;
  constexpr int kDraws = 10;
  for (int draw = 0; draw < kDraws; ++draw) {
    cv::Mat grain(stored.image.size(), CV_32F);
    noise.fill(grain, cv::RNG::NORMAL, 0.0, 30.0);
    // Coarser than a pixel, finer than the low-pass, as shadows of small things are.
    cv::GaussianBlur(grain, grain, {}, 3.0);
    Panorama grainy{cv::Mat(), stored.geometry};
    cv::add(stored.image, grain, grainy.image, cv::noArray(), CV_8U);
    const auto found = photometricOffset(grainy, stored, floorKnown());
    ASSERT_TRUE(found);
    const Eigen::Vector3d off(found->hMp.x, found->hMp.y, found->hMp.heading);
    sum += off.dot(found->covariance.inverse() * off) / 3.0;
  }
  EXPECT_GT(sum / kDraws, 0.3);
  EXPECT_LT(sum / kDraws, 3.0);
}

TEST(PhotometricOffset, isZeroAtHome)
{
  const Panorama view = SyntheticRoom(31, 6.0, 5.0).view({});
  const auto found = photometricOffset(view, view);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->hMp.translation().norm(), 0.0);
  EXPECT_EQ(found->hMp.heading, 0.0);
  EXPECT_NEAR(found->correlation, 1.0, 1e-6);
  EXPECT_GT(found->covariance(0, 0), 0.0) << "no picture is exact";
}

TEST(PhotometricOffset, isAsLongAsTheRangeSays)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  PhotometricOffsetOptions options;
  const auto once = photometricOffset(room.view({0.03, 0.01, 0.02}), room.view({}), options);
  options.sphere.range *= 2.0;
  const auto twice = photometricOffset(room.view({0.03, 0.01, 0.02}), room.view({}), options);
  ASSERT_TRUE(once && twice);
  EXPECT_NEAR(twice->hMp.x, 2.0 * once->hMp.x, 1e-3);
  EXPECT_NEAR(twice->hMp.heading, once->hMp.heading, 1e-3);
}

TEST(PhotometricOffset, picturesThatTellNothingGiveNoAnswer)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const Panorama view = room.view({});
  Panorama blank = view;
  blank.image = cv::Mat::zeros(view.image.size(), CV_8UC1);
  EXPECT_FALSE(photometricOffset(blank, view));
  EXPECT_FALSE(photometricOffset(view, blank));
  EXPECT_FALSE(photometricOffset(blank, blank));
  EXPECT_FALSE(photometricOffset(view, SyntheticRoom(32, 6.0, 5.0).view({}))) << "another room";
  EXPECT_FALSE(photometricOffset(room.view({1.0, 0.5, 0.0}), view)) << "too far";
  EXPECT_FALSE(photometricOffset(room.view({0.0, 0.0, 1.5}), view)) << "turned too far";
  EXPECT_FALSE(photometricOffset(view, view, {}, cv::Mat::zeros(view.image.size(), CV_8UC1)))
      << "nothing visible";
}

/** Rings at every elevation with a faint wave round the horizon, gray levels. */
Panorama rings(double wave)
{
  const PanoramaGeometry geometry;
  Panorama rings{cv::Mat(geometry.height, geometry.width, CV_8UC1), geometry};
  for (int v = 0; v < geometry.height; ++v) {
    for (int u = 0; u < geometry.width; ++u) {
      rings.image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(
          120.0 + 80.0 * std::sin(0.1 * v) + wave * std::sin(3.0 * geometry.azimuth(u)));
    }
  }
  return rings;
}

TEST(PhotometricOffset, aFreedomThatHardlyShowsGivesNoAnswer)
{
  EXPECT_FALSE(photometricOffset(rings(0.0), rings(0.0)));
  EXPECT_FALSE(photometricOffset(rings(0.6), rings(0.6)));
  EXPECT_TRUE(photometricOffset(rings(20.0), rings(20.0)));
}

TEST(PhotometricOffset, answersOnlyWithinReach)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const Panorama stored = room.view({});
  PhotometricOffsetOptions options = floorKnown();
  const Panorama aside = room.view({0.05, 0.0, 0.0});
  const Panorama turned = room.view({0.0, 0.0, 0.05});
  EXPECT_TRUE(photometricOffset(aside, stored, options));
  EXPECT_TRUE(photometricOffset(turned, stored, options));
  options.reach = 0.03;
  options.turn = 0.03;
  EXPECT_FALSE(photometricOffset(aside, stored, options));
  EXPECT_FALSE(photometricOffset(turned, stored, options));
}

TEST(PhotometricOffset, picturesThatStayUnlikeGiveNoAnswer)
{
  const SyntheticRoom room(31, 6.0, 5.0);
  const Panorama stored = room.view({});
  const Panorama otherLamp = room.view({}, {0.8, 0.0, 0.25, 1.0});
  PhotometricOffsetOptions options = floorKnown();
  const auto found = photometricOffset(otherLamp, stored, options);
  ASSERT_TRUE(found);
  options.leastCorrelation = found->correlation + 0.01;
  EXPECT_FALSE(photometricOffset(otherLamp, stored, options));
}

TEST(PhotometricOffset, refusesBadInput)
{
  const Panorama view = SyntheticRoom(31, 6.0, 5.0).view({});
  Panorama other = view;
  other.geometry.elevationMax = radians(30.0);
  EXPECT_THROW(photometricOffset(other, view), LogicError);
  EXPECT_THROW(photometricOffset({cv::Mat(), view.geometry}, view), LogicError);
  PanoramaGeometry none;
  none.width = 0;
  none.height = 0;
  EXPECT_THROW(photometricOffset({cv::Mat(), none}, {cv::Mat(), none}), LogicError);
  PhotometricOffsetOptions options;
  options.reach = 0.0;
  EXPECT_THROW(photometricOffset(view, view, options), LogicError);
  options.reach = std::nan("");
  EXPECT_THROW(photometricOffset(view, view, options), LogicError);
}

} // namespace
} // namespace homeward
