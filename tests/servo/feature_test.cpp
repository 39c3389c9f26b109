// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#if defined(__GNUC__) && !defined(__clang__) && __cplusplus >= 202002L

// The headers of ViSP 3.5 are no C++20 to GCC; homeward_visp_sources() compiles a file as C++17.
TEST(FeatureHomeVector, needsViSPHeaders)
{
  GTEST_SKIP() << "not compiled as C++17: name servo/feature_test.cpp in homeward_visp_sources()";
}

#else

#include <homeward/core/error.h>
#include <homeward/core/pose2.h>
#include <homeward/servo/feature_heading.h>
#include <homeward/servo/feature_home_vector.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace homeward
{
namespace
{

constexpr double kStep = 1e-6;

/** Pose of p after kStep of a planar twist (vx, vy, wz) from the origin, to first order. */
Pose2 moved(const std::array<double, 3> &twist)
{
  return {twist[0] * kStep, twist[1] * kStep, twist[2] * kStep};
}

TEST(FeatureHomeVector, interactionIsTheDerivative)
{
  constexpr std::array<unsigned int, 3> kColumns{0, 1, 5}; // vx, vy, wz
  for (const double rho : {0.3, 1.0, 4.0}) {
    for (const double beta : {-3.0, -1.2, 0.0, 0.7, 2.4}) {
      FeatureHomeVector feature;
      feature.set(rho, beta);
      const vpMatrix L = feature.interaction();
      ASSERT_EQ(L.getRows(), 2U);
      ASSERT_EQ(L.getCols(), 6U);
      const Eigen::Vector2d home(rho * std::cos(beta), rho * std::sin(beta));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<double, 3> twist{};
        twist[axis] = 1.0;
        const Eigen::Vector2d seen = moved(twist).inverse() * home;
        const double rhoRate = (seen.norm() - rho) / kStep;
        const double betaRate = wrapAngle(std::atan2(seen.y(), seen.x()) - beta) / kStep;
        EXPECT_NEAR(L[0][kColumns[axis]], rhoRate, 1e-4) << "rho " << rho << " beta " << beta;
        EXPECT_NEAR(L[1][kColumns[axis]], betaRate, 1e-4) << "rho " << rho << " beta " << beta;
      }
      for (const unsigned int column : {2U, 3U, 4U}) {
        EXPECT_EQ(L[0][column], 0.0);
        EXPECT_EQ(L[1][column], 0.0);
      }
    }
  }
}

TEST(FeatureHomeVector, errorTakesTheShortWayRound)
{
  FeatureHomeVector now;
  FeatureHomeVector wanted;
  now.set(2.0, 3.0);
  wanted.set(0.5, -3.0);
  const vpColVector error = now.error(wanted);
  EXPECT_DOUBLE_EQ(error[0], 1.5);
  EXPECT_NEAR(error[1], 6.0 - 2.0 * kPi, 1e-12);
}

TEST(FeatureHomeVector, selectsRows)
{
  FeatureHomeVector now;
  FeatureHomeVector wanted;
  now.set(2.0, 0.5);
  wanted.set(1.0, 0.2);
  const vpColVector beta = now.error(wanted, FeatureHomeVector::selectBeta());
  ASSERT_EQ(beta.getRows(), 1U);
  EXPECT_DOUBLE_EQ(beta[0], 0.3);
  const vpMatrix L = now.interaction(FeatureHomeVector::selectRho());
  ASSERT_EQ(L.getRows(), 1U);
  EXPECT_DOUBLE_EQ(L[0][0], -std::cos(0.5));
  EXPECT_EQ(now.getDimension(FeatureHomeVector::selectBeta()), 1U);
  EXPECT_EQ(now.getDimension(), 2U);
}

TEST(FeatureHomeVector, refusesTheSingularity)
{
  FeatureHomeVector feature;
  EXPECT_THROW(feature.set(0.0, 0.0), LogicError);
  EXPECT_THROW(feature.set(-1.0, 0.0), LogicError);
  EXPECT_THROW(feature.set(1.0, std::numeric_limits<double>::quiet_NaN()), LogicError);
}

TEST(FeatureHomeVector, duplicates)
{
  FeatureHomeVector feature;
  feature.set(2.0, 0.5);
  const std::unique_ptr<vpBasicFeature> copy(feature.duplicate());
  EXPECT_DOUBLE_EQ((*copy)[0], 2.0);
  EXPECT_DOUBLE_EQ((*copy)[1], 0.5);
}

TEST(FeatureHeading, turningLeftRaisesIt)
{
  FeatureHeading feature;
  feature.set(0.4);
  const vpMatrix L = feature.interaction();
  ASSERT_EQ(L.getRows(), 1U);
  for (unsigned int column = 0; column < 6; ++column) {
    EXPECT_EQ(L[0][column], column == 5 ? 1.0 : 0.0);
  }
}

TEST(FeatureHeading, errorTakesTheShortWayRound)
{
  FeatureHeading now;
  FeatureHeading wanted;
  now.set(-3.1);
  wanted.set(3.1);
  EXPECT_NEAR(now.error(wanted)[0], 2.0 * kPi - 6.2, 1e-12);
  EXPECT_THROW(now.set(std::numeric_limits<double>::infinity()), LogicError);
}

} // namespace
} // namespace homeward

#endif
