// SPDX-License-Identifier: GPL-3.0-or-later
#include "../../modules/homing/src/planar_motion.h"
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/homing/bearing_homing.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

Eigen::Vector3d anyBearing(Random &random)
{
  const double azimuth = random.uniform(-kPi, kPi);
  const double elevation = random.uniform(radians(-45.0), radians(35.0));
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/** Landmarks 1 to 5 m away, seen from the snapshot and after a movement of so many metres. */
std::vector<BearingPair> pairsOf(Random &random, const PlanarMotion &motion, double metres,
                                 int count)
{
  std::vector<BearingPair> pairs;
  const Eigen::Vector3d moved =
      metres * Eigen::Vector3d(std::cos(motion.alpha), std::sin(motion.alpha), 0.0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d snapshot = anyBearing(random);
    const Eigen::Vector3d seen = random.uniform(1.0, 5.0) * snapshot - moved;
    const double c = std::cos(motion.psi);
    const double s = std::sin(motion.psi);
    const Eigen::Vector3d current(c * seen.x() + s * seen.y(), -s * seen.x() + c * seen.y(),
                                  seen.z());
    pairs.push_back({current.normalized(), snapshot});
  }
  return pairs;
}

double off(double angle, double truth)
{
  return degrees(std::abs(wrapAngle(angle - truth)));
}

TEST(PlanarMotion, twoLandmarksTellTheMovement)
{
  Random random(17, 0);
  for (int i = 0; i < 100; ++i) {
    const PlanarMotion truth{random.uniform(-kPi, kPi), random.uniform(-kPi, kPi)};
    const std::vector<BearingPair> pairs = pairsOf(random, truth, 0.8, 2);
    double best = 180.0;
    for (const PlanarMotion &motion : solvePlanarMotion(pairs[0], pairs[1])) {
      best = std::min(best, off(motion.alpha, truth.alpha) + off(motion.psi, truth.psi));
    }
    EXPECT_LT(best, 1e-4) << "sample " << i;
  }
}

TEST(PlanarMotion, onlyTheWayForwardLeavesLandmarksInFront)
{
  Random random(18, 0);
  const PlanarMotion truth{0.7, -2.0};
  double backwards = 0.0;
  for (const BearingPair &pair : pairsOf(random, truth, 0.8, 50)) {
    EXPECT_LT(bearingResidual(pair, truth), 1e-6);
    backwards += bearingResidual(pair, {truth.alpha + kPi, truth.psi}) / 50.0;
  }
  EXPECT_GT(backwards, 0.1);
}

TEST(PlanarMotion, isFoundAmongMostlyWrongMatches)
{
  Random random(19, 0);
  const PlanarMotion truth{-1.1, 2.6};
  std::vector<BearingPair> pairs = pairsOf(random, truth, 0.5, 40);
  for (int i = 0; i < 120; ++i) {
    pairs.push_back({anyBearing(random), anyBearing(random)});
  }
  const auto fit = findPlanarMotion(pairs, {});
  ASSERT_TRUE(fit);
  EXPECT_LT(off(fit->motion.alpha, truth.alpha), 3.0);
  EXPECT_LT(off(fit->motion.psi, truth.psi), 0.5);
  EXPECT_GE(fit->inliers.size(), 40U);
  EXPECT_LT(fit->rival, 0.7 * fit->score);
  EXPECT_EQ(fit->motion.alpha, findPlanarMotion(pairs, {})->motion.alpha) << "not the same again";
}

TEST(PlanarMotion, withoutParallaxOnlyTheTurnIsKnown)
{
  Random random(20, 0);
  const auto fit = findPlanarMotion(pairsOf(random, {0.0, 1.2}, 0.0, 60), {});
  ASSERT_TRUE(fit);
  EXPECT_LT(off(fit->motion.psi, 1.2), 0.1);
  EXPECT_GT(fit->alphaSigma, radians(30.0));
}

TEST(PlanarMotion, needsTwoLandmarks)
{
  Random random(21, 0);
  EXPECT_FALSE(findPlanarMotion({}, {}));
  EXPECT_FALSE(findPlanarMotion(pairsOf(random, {}, 1.0, 1), {}));
}

class Bearing : public testing::Test
{
protected:
  SyntheticRoom m_room{11, 6.0, 5.0};
  BearingHoming m_method;
};

TEST_F(Bearing, atHomeTheTurnIsRightAndNoDirectionSure)
{
  for (const double turn : {0.0, 1.0, -2.5}) {
    const auto found = m_method.compute(m_room.view({0.3, -0.2, turn}), m_room.view({0.3, -0.2}));
    ASSERT_TRUE(found);
    EXPECT_LT(off(found->headingChange, turn), 0.5);
    EXPECT_LT(found->confidence, 0.4);
    EXPECT_LT(found->distanceProxy, 0.05);
  }
  const auto away = m_method.compute(m_room.view({0.9, -0.2, 1.0}), m_room.view({0.3, -0.2}));
  ASSERT_TRUE(away);
  EXPECT_GT(away->confidence, 0.8);
}

TEST_F(Bearing, holdsUnderChangedLight)
{
  const Pose2 home{-0.3, 0.4, 0.5};
  for (const Pose2 &here : {Pose2{0.5, 0.0, 2.0}, Pose2{0.2, -0.6, -1.0}, Pose2{-1.2, 0.3, 3.0}}) {
    const auto found = m_method.compute(
        m_room.view(here, {.gain = 0.5, .offset = 10.0, .slope = 0.3, .from = 1.0}),
        m_room.view(home));
    ASSERT_TRUE(found);
    EXPECT_LT(off(found->direction, trueDirection(here, home)), 3.0);
    EXPECT_LT(off(found->headingChange, here.heading - home.heading), 1.0);
  }
}

TEST_F(Bearing, theProxyIsTheDistanceOverThatOfTheWalls)
{
  const auto found = m_method.compute(m_room.view({0.6, 0.0, 0.4}), m_room.view({}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distanceProxy, 0.6 / 2.5, 0.15);
}

TEST_F(Bearing, anotherPlaceIsUnsure)
{
  const SyntheticRoom other{12, 5.0, 6.0};
  const auto found = m_method.compute(other.view({}), m_room.view({}));
  EXPECT_TRUE(!found || found->confidence < 0.3);
}

TEST(BearingHoming, refusesBadOptions)
{
  EXPECT_THROW(BearingHoming({.tolerance = 0.0}), LogicError);
  EXPECT_THROW(BearingHoming({.mostSamples = 0}), LogicError);
  EXPECT_THROW(BearingHoming({.leastMatches = 1}), LogicError);
}

} // namespace
} // namespace homeward
