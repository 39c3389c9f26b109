// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/homing/average_landmark_vector.h>
#include <homeward/homing/combined_homing.h>
#include <homeward/homing/descent_in_image_distance.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** Something hides half of the view: min-warping is unsure, right matches are left. */
Panorama halfCovered(Panorama panorama)
{
  panorama.image.colRange(0, panorama.image.cols / 2).setTo(0);
  return panorama;
}

class Combined : public testing::Test
{
protected:
  SyntheticRoom m_room{11, 6.0, 5.0};
  Panorama m_home = m_room.view({-0.2, 0.1, 0.3});
  Panorama m_here = halfCovered(m_room.view({0.6, -0.3, 1.5}));
  HomeVector m_warped = MinWarping().compute(m_here, m_home).value();
  HomeVector m_seen = BearingHoming().compute(m_here, m_home).value();
};

TEST_F(Combined, sureMinWarpingIsTheAnswer)
{
  const auto found = CombinedHoming({.sure = 0.0, .bearingSure = 0.0}).compute(m_here, m_home);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->direction, m_warped.direction);
  EXPECT_NE(found->direction, m_seen.direction);
}

TEST_F(Combined, sureBearingsOverruleUnsureMinWarping)
{
  ASSERT_LT(m_warped.confidence, 1.0);
  const auto found = CombinedHoming({.sure = 1.0, .bearingSure = 0.5}).compute(m_here, m_home);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->direction, m_seen.direction);
  EXPECT_EQ(found->confidence, m_seen.confidence);
}

TEST_F(Combined, unsureBearingsDoNot)
{
  // At home no direction by bearings is sure.
  const auto found = CombinedHoming({.sure = 1.0, .bearingSure = 0.9}).compute(m_home, m_home);
  const auto warped = MinWarping().compute(m_home, m_home);
  ASSERT_TRUE(found && warped);
  EXPECT_EQ(found->direction, warped->direction);
  EXPECT_EQ(found->confidence, warped->confidence);
}

TEST(CombinedHoming, refusesBadOptions)
{
  EXPECT_THROW(CombinedHoming({.sure = 1.5}), LogicError);
  EXPECT_THROW(CombinedHoming({.bearingSure = -0.1}), LogicError);
}

TEST(AverageLandmarkVector, refusesBadOptions)
{
  EXPECT_THROW(AverageLandmarkVector({.columns = 10}), LogicError);
  EXPECT_THROW(AverageLandmarkVector({.rows = 8}), LogicError);
  EXPECT_THROW(AverageLandmarkVector({.band = 0.0}), LogicError);
  EXPECT_THROW(AverageLandmarkVector({.edgeContrast = 0.0}), LogicError);
}

TEST(DescentInImageDistance, refusesBadOptions)
{
  EXPECT_THROW(DescentInImageDistance({.columns = 10}), LogicError);
  EXPECT_THROW(DescentInImageDistance({.blur = 0.0}), LogicError);
}

} // namespace
} // namespace homeward
