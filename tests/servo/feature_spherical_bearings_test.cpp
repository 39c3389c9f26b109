// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_task.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/servo/feature_spherical_bearings.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace homeward
{
namespace
{

/** Points of a room, in the frame of home; metres. */
std::vector<Eigen::Vector3d> points(std::size_t count)
{
  Random random(7, 1);
  std::vector<Eigen::Vector3d> all;
  while (all.size() < count) {
    const double azimuth = random.uniform(-kPi, kPi);
    const double distance = random.uniform(0.8, 4.0);
    all.emplace_back(distance * std::cos(azimuth), distance * std::sin(azimuth),
                     random.uniform(-0.9, 1.5));
  }
  return all;
}

/** Bearings from hMp, ranges wrong by a factor. */
std::vector<SphericalBearing> seen(const std::vector<Eigen::Vector3d> &points,
                                   const Eigen::Isometry3d &hMp, double rangeFactor = 1.0)
{
  std::vector<SphericalBearing> bearings;
  for (const Eigen::Vector3d &point : points) {
    const Eigen::Vector3d inCamera = hMp.inverse() * point;
    bearings.push_back({inCamera.normalized(), rangeFactor * inCamera.norm()});
  }
  return bearings;
}

Eigen::Isometry3d planar(const Pose2 &pose)
{
  Eigen::Isometry3d aMb = Eigen::Isometry3d::Identity();
  aMb.translate(Eigen::Vector3d(pose.x, pose.y, 0.0));
  aMb.rotate(Eigen::AngleAxisd(pose.heading, Eigen::Vector3d::UnitZ()));
  return aMb;
}

/** hMp after a small motion along axis 0 to 5 of the twist of p. */
Eigen::Isometry3d moved(std::size_t axis, double step)
{
  Eigen::Isometry3d hMp = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d along = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(axis % 3));
  if (axis < 3) {
    hMp.translate(Eigen::Vector3d(step * along));
  }
  else {
    hMp.rotate(Eigen::AngleAxisd(step, along));
  }
  return hMp;
}

TEST(FeatureSphericalBearings, interactionIsTheDerivativeForAllSixFreedoms)
{
  constexpr double kStep = 1e-6;
  const std::vector<Eigen::Vector3d> world = points(7);
  FeatureSphericalBearings feature;
  feature.set(seen(world, Eigen::Isometry3d::Identity()));
  const vpMatrix L = feature.interaction();
  ASSERT_EQ(L.getRows(), 21U);
  ASSERT_EQ(L.getCols(), 6U);
  for (unsigned int axis = 0; axis < 6; ++axis) {
    FeatureSphericalBearings before;
    FeatureSphericalBearings after;
    before.set(seen(world, moved(axis, -kStep)));
    after.set(seen(world, moved(axis, kStep)));
    for (unsigned int row = 0; row < L.getRows(); ++row) {
      EXPECT_NEAR(L[row][axis], (after[row] - before[row]) / (2.0 * kStep), 1e-8)
          << "row " << row << " axis " << axis;
    }
  }
}

TEST(FeatureSphericalBearings, landmarkAheadMovesRightOfTheRobotThatTurnsLeft)
{
  FeatureSphericalBearings feature;
  feature.set({{Eigen::Vector3d::UnitX(), 2.0}});
  const vpMatrix L = feature.interaction();
  EXPECT_EQ(L[1][5], -1.0); // wz
  EXPECT_EQ(L[1][1], -0.5); // vy
  EXPECT_EQ(L[0][0], 0.0);  // vx
}

TEST(FeatureSphericalBearings, predictsWhatASmallMotionChanges)
{
  const std::vector<Eigen::Vector3d> world = points(30);
  const Pose2 motion{0.02, -0.03, radians(1.5)};
  FeatureSphericalBearings now;
  FeatureSphericalBearings then;
  now.set(seen(world, Eigen::Isometry3d::Identity()));
  then.set(seen(world, planar(motion)));
  vpColVector twist(6);
  twist[0] = motion.x;
  twist[1] = motion.y;
  twist[5] = motion.heading;
  const vpColVector predicted = now.interaction() * twist;
  const vpColVector change = then.error(now);
  EXPECT_LT((predicted - change).frobeniusNorm(), 0.03 * change.frobeniusNorm());
}

struct FlightCase
{
  std::string name;
  std::size_t points;
  double rangeFactor;
  double constantRange; ///< metres; 0: the true one times rangeFactor
};

class BearingsFlight : public testing::TestWithParam<FlightCase>
{};

TEST_P(BearingsFlight, comesHomeFrom15CentimetresAnd10Degrees)
{
  const std::vector<Eigen::Vector3d> world = points(GetParam().points);
  const auto look = [&](const Pose2 &hMp) {
    std::vector<SphericalBearing> bearings = seen(world, planar(hMp), GetParam().rangeFactor);
    for (SphericalBearing &bearing : bearings) {
      bearing.range = GetParam().constantRange > 0.0 ? GetParam().constantRange : bearing.range;
    }
    return bearings;
  };
  FeatureSphericalBearings now;
  FeatureSphericalBearings wanted;
  wanted.set(look({}));
  for (int start = 0; start < 8; ++start) {
    const double away = start * kPi / 4.0;
    const Pose2 end = flyHome(
        now, wanted,
        {0.15 * std::cos(away), 0.15 * std::sin(away), radians(start % 2 == 0 ? 10.0 : -10.0)}, 60,
        [&](const Pose2 &hMp) { now.set(look(hMp)); });
    EXPECT_LT(end.translation().norm(), 0.002) << "start " << start;
    EXPECT_LT(std::abs(degrees(end.heading)), 0.05) << "start " << start;
  }
}

INSTANTIATE_TEST_SUITE_P(Ranges, BearingsFlight,
                         testing::Values(FlightCase{"exact", 30, 1.0, 0.0},
                                         FlightCase{"twiceTooFar", 30, 2.0, 0.0},
                                         FlightCase{"halfTooNear", 30, 0.5, 0.0},
                                         FlightCase{"constant", 30, 1.0, 2.0},
                                         FlightCase{"threePoints", 3, 1.0, 0.0},
                                         FlightCase{"sevenPointsMoreRowsThanFlags", 7, 1.0, 0.0}),
                         [](const auto &instance) { return instance.param.name; });

TEST(FeatureSphericalBearings, refusesBadInput)
{
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
  FeatureSphericalBearings feature;
  feature.set({{ahead, 1.0}});
  EXPECT_THROW(feature.set({}), LogicError);
  EXPECT_THROW(feature.set({{2.0 * ahead, 1.0}}), LogicError);
  EXPECT_THROW(feature.set({{kNan * ahead, 1.0}}), LogicError);
  EXPECT_THROW(feature.set({{ahead, 0.0}}), LogicError);
  EXPECT_THROW(feature.set({{ahead, -1.0}}), LogicError);
  EXPECT_THROW(feature.set({{ahead, kNan}}), LogicError);
  EXPECT_THROW(feature.set({{ahead, kInfinite}}), LogicError);
  EXPECT_EQ(feature[0], 1.0) << "a refused input changes nothing";
  FeatureSphericalBearings other;
  other.set({{ahead, 1.0}, {Eigen::Vector3d::UnitY(), 1.0}});
  EXPECT_THROW(feature.error(other), LogicError);
}

TEST(FeatureSphericalBearings, duplicates)
{
  FeatureSphericalBearings feature;
  feature.set(seen(points(9), Eigen::Isometry3d::Identity()));
  const std::unique_ptr<vpBasicFeature> copy(feature.duplicate());
  EXPECT_EQ(feature.error(*copy).frobeniusNorm(), 0.0);
  const vpMatrix difference = feature.interaction() - copy->interaction();
  EXPECT_EQ(difference.frobeniusNorm(), 0.0);
}

} // namespace
} // namespace homeward
