// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/homing/visual_compass.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

class VisualCompass : public testing::Test
{
protected:
  SyntheticRoom m_room{31, 6.0, 5.0};
};

TEST_F(VisualCompass, robotTurnedLeftBy90ReadsPlus90)
{
  const std::optional<CompassReading> reading =
      visualCompass(m_room.view({0.0, 0.0, kPi / 2.0}), m_room.view({}), kZeilCompass);
  ASSERT_TRUE(reading);
  EXPECT_NEAR(degrees(reading->headingChange), 90.0, 0.1);
  EXPECT_GT(reading->confidence, 0.9);
}

TEST_F(VisualCompass, readsTurnsToAFractionOfAColumn)
{
  const Panorama home = m_room.view({0.2, 0.1, 0.7});
  for (const double turn : {0.0, 3.7, -41.3, 120.9, 179.6}) {
    const std::optional<CompassReading> reading =
        visualCompass(m_room.view({0.2, 0.1, 0.7 + radians(turn)}), home, kZeilCompass);
    ASSERT_TRUE(reading);
    EXPECT_NEAR(degrees(wrapAngle(reading->headingChange - radians(turn))), 0.0, 0.2) << turn;
  }
}

TEST_F(VisualCompass, agreesWithTryingEveryShift)
{
  const PanoramaGeometry small{.width = 90, .height = 20};
  const Panorama home = m_room.view({0.1, 0.0, 0.2}, {}, small);
  const Panorama current = m_room.view({0.2, -0.1, 2.2}, {}, small);
  int best = 0;
  double least = 1e18;
  for (int k = 0; k < small.width; ++k) {
    double ssd = 0.0;
    for (int row = 0; row < small.height; ++row) {
      for (int u = 0; u < small.width; ++u) {
        const double difference = current.image.at<std::uint8_t>(row, (u + k) % small.width) -
                                  static_cast<double>(home.image.at<std::uint8_t>(row, u));
        ssd += difference * difference;
      }
    }
    if (ssd < least) {
      least = ssd;
      best = k;
    }
  }
  const std::optional<CompassReading> reading = visualCompass(current, home, kZeilCompass);
  ASSERT_TRUE(reading);
  const double column = 2.0 * kPi / small.width;
  EXPECT_NEAR(wrapAngle(reading->headingChange - best * column), 0.0, 0.5001 * column);
}

TEST_F(VisualCompass, isSurerNearby)
{
  const Panorama home = m_room.view({});
  const std::optional<CompassReading> near =
      visualCompass(m_room.view({0.1, 0.0, 1.0}), home, kZeilCompass);
  const std::optional<CompassReading> far =
      visualCompass(m_room.view({1.2, 0.8, 1.0}), home, kZeilCompass);
  ASSERT_TRUE(near && far);
  EXPECT_GT(near->confidence, far->confidence);
}

TEST_F(VisualCompass, uniformPicturesGiveNoAnswer)
{
  const Panorama home = m_room.view({});
  const Panorama black{cv::Mat::zeros(home.image.size(), CV_8UC1), home.geometry};
  EXPECT_FALSE(visualCompass(black, home, kZeilCompass));
  EXPECT_FALSE(visualCompass(home, black, kZeilCompass));
  EXPECT_FALSE(visualCompass(black, black, kZeilCompass));
}

TEST_F(VisualCompass, refusesPanoramasOfDifferentGeometry)
{
  EXPECT_THROW(visualCompass(m_room.view({}), m_room.view({}, {}, {.width = 360})), LogicError);
}

TEST_F(VisualCompass, onEdgesReadsTurnsInAnotherLight)
{
  const RoomLight evening{0.35, 12.0, 0.6, 1.0};
  const Panorama home = m_room.view({0.2, 0.1, 0.7});
  for (const double turn : {0.0, 3.7, -41.3, 120.9, 179.6}) {
    const Panorama current = m_room.view({0.2, 0.1, 0.7 + radians(turn)}, evening);
    const std::optional<CompassReading> reading = visualCompass(current, home);
    ASSERT_TRUE(reading);
    EXPECT_NEAR(degrees(wrapAngle(reading->headingChange - radians(turn))), 0.0, 0.2) << turn;
    EXPECT_GT(reading->confidence, 0.5);
  }
}

TEST_F(VisualCompass, onEdgesSaysNothingOfUniformPictures)
{
  const Panorama home = m_room.view({});
  const Panorama gray{cv::Mat(home.image.size(), CV_8UC1, cv::Scalar(90)), home.geometry};
  EXPECT_FALSE(visualCompass(gray, home));
  EXPECT_FALSE(visualCompass(home, gray));
  EXPECT_FALSE(visualCompass(gray, gray));
}

TEST_F(VisualCompass, refusesMoreBandsThanRows)
{
  const Panorama home = m_room.view({});
  EXPECT_THROW(visualCompass(home, home, {1000, false}), LogicError);
  EXPECT_THROW(visualCompass(home, home, {-1, false}), LogicError);
}

} // namespace
} // namespace homeward
