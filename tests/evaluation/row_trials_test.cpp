// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/evaluation/row_trials.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** A signature that says where it was taken, as a histogram of two bins. */
Signature at(double place)
{
  return {SignatureKind::AbsoluteDifferences,
          100,
          {static_cast<float>(place), static_cast<float>(100.0 - place)}};
}

// An empty room of 8 m x 4 m.
FreeSpace hall()
{
  const auto caster =
      std::make_shared<const RayCaster>(share(makeRoom(8.0F, 4.0F)), RayCaster::Layer::Collision);
  const auto map = std::make_shared<const CollisionMap>(*caster, testRobot());
  return {map, FloorGrid(*map), caster, 0.9, Eigen::Vector2d(2.0, 1.0)};
}

TEST(RowTrials, rowsAreParallelToTheDriveAndOnReachableFloor)
{
  const FreeSpace space = hall();
  const std::vector<RowPoses> drives = placeRows(space, 5, 3);
  ASSERT_EQ(drives.size(), 5U);
  const RowOptions options;
  std::size_t rows = 0;
  for (const RowPoses &drive : drives) {
    ASSERT_EQ(drive.seen.size(), 16U);
    EXPECT_NEAR((drive.seen.back().translation() - drive.seen.front().translation()).norm(), 4.5,
                1e-9);
    ASSERT_EQ(drive.known.size(), options.distances.size());
    for (std::size_t d = 0; d < drive.known.size(); ++d) {
      for (std::size_t i = 0; i < drive.known[d].size(); ++i) {
        EXPECT_TRUE(space.reachable(drive.known[d][i].translation()));
        EXPECT_NEAR((drive.known[d][i].translation() - drive.seen[3 * i].translation()).norm(),
                    options.distances[d], 1e-9);
        ++rows;
      }
    }
    EXPECT_EQ(drive.known.front().size(), 6U) << "the drive itself is free";
  }
  EXPECT_GT(rows, 100U);
  EXPECT_TRUE(placeRows(space, 1, 3, {.seen = 40}).empty()) << "12 m do not fit";
}

TEST(RowTrials, aDriveBesideARowIsLocalized)
{
  std::vector<Pose2> knownPoses;
  std::vector<Signature> known;
  for (int i = 0; i < 6; ++i) {
    knownPoses.push_back({0.9 * i, 0.3, 0.0});
    known.push_back(at(9.0 * i));
  }
  std::vector<Pose2> seenPoses;
  std::vector<Signature> seen;
  std::vector<Signature> mirrored;
  for (int i = 0; i < 16; ++i) {
    seenPoses.push_back({0.3 * i, 0.0, 0.0});
    seen.push_back(at(3.0 * i));
    mirrored.push_back(at(45.0 - 3.0 * i));
  }
  // The filter follows late: its sigma is that of all dissimilarities, large where these are even.
  EXPECT_GE(rowSuccess(knownPoses, known, seenPoses, seen, {}), 10.0 / 16.0);
  EXPECT_LE(rowSuccess(knownPoses, known, seenPoses, mirrored, {}), 4.0 / 16.0);
}

} // namespace
} // namespace homeward
