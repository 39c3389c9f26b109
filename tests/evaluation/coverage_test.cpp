// SPDX-License-Identifier: GPL-3.0-or-later
#include "room_space.h"

#include <homeward/evaluation/coverage.h>
#include <homeward/evaluation/mission_truth.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

const Eigen::Vector2d kStart(1.0, 1.0);

TEST(Coverage, growsRoomByRoomAndEndsAtTheMissionsTruth)
{
  const FreeSpace space = twoRooms();
  const std::vector<CoverageSample> samples = coverageOverTime(
      space, kStart, {{5.0, {2.0, 2.0}}, {9.0, {2.0, 2.0}}, {20.0, {6.0, 2.0}}}, 3.0);
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[0].seconds, 5.0);
  EXPECT_NEAR(samples[0].coverage, 0.5, 0.06);
  EXPECT_EQ(samples[1].coverage, samples[0].coverage) << "nothing new";
  EXPECT_EQ(samples[2].seconds, 20.0);
  const std::map<NodeId, Pose2> nodes{{NodeId{0}, {2.0, 2.0, 0.0}}, {NodeId{1}, {6.0, 2.0, 0.0}}};
  EXPECT_EQ(
      samples[2].coverage,
      judgeMission(space, kStart, nodes, std::vector<std::pair<NodeId, NodeId>>{}, 2.0).coverage);
}

TEST(Coverage, ofAStartWithoutRoomIsNone)
{
  const FreeSpace space = twoRooms();
  CoverageMeter meter(space, {-50.0, 0.0}, 3.0);
  meter.add({2.0, 2.0});
  EXPECT_EQ(meter.share(), 0.0);
}

} // namespace
} // namespace homeward
