// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/evaluation/localization_run.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** A histogram of 100 pixels, `bright` of them in the second bin. */
Signature histogram(float bright)
{
  return {SignatureKind::AbsoluteDifferences, 100, {100.0F - bright, bright}};
}

// Places 0 to 4 in a row, 0.9 m apart. Places 0 and 4 look alike.
const std::vector<Pose2> kPlaces{{0, 0, 0}, {0.9, 0, 1}, {1.8, 0, 2}, {2.7, 0, 3}, {3.6, 0, -1}};

KnownPlaces places()
{
  KnownPlaces known;
  for (const float bright : {10.0F, 30.0F, 50.0F, 70.0F, 10.0F}) {
    known.nodes.push_back(NodeId{static_cast<std::int64_t>(known.nodes.size())});
    known.signatures.push_back(histogram(bright));
  }
  known.steps = stepsBetween(kPlaces);
  return known;
}

TEST(LocalizationRun, stepsAreDistancesOfNeighbours)
{
  const Eigen::MatrixXd steps = stepsBetween(kPlaces);
  EXPECT_EQ(steps(0, 0), 0.0);
  EXPECT_EQ(steps(1, 2), 1.0);
  EXPECT_EQ(steps(4, 0), 4.0);
  EXPECT_EQ(stepsBetween({{1, 2, 0}})(0, 0), 0.0);
}

TEST(LocalizationRun, nearestPlace)
{
  EXPECT_EQ(nearestPlace(kPlaces, {1.2, 0.3, 0}), 1U);
  EXPECT_THROW(nearestPlace({}, {}), LogicError);
}

TEST(LocalizationRun, placesThatLookAlikeAreToldApartByTheWayThere)
{
  const std::vector<Signature> drive{histogram(50), histogram(70), histogram(10)};
  const std::vector<Localization> found = localize(places(), drive, std::nullopt);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].node, NodeId{2});
  EXPECT_EQ(found[1].node, NodeId{3});
  EXPECT_EQ(found[2].node, NodeId{4});
  EXPECT_GT(found[2].probability, 0.3) << "chance is 0.2";
}

TEST(LocalizationRun, aKnownStartDecidesWhatSightCannot)
{
  EXPECT_EQ(localize(places(), {histogram(10)}, NodeId{4})[0].node, NodeId{4});
  EXPECT_EQ(localize(places(), {histogram(10)}, NodeId{0})[0].node, NodeId{0});
}

} // namespace
} // namespace homeward
