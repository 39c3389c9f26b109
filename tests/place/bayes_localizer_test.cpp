// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/place/bayes_localizer.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace homeward
{
namespace
{

// Nodes 10 - 11 - 12 - 13 in a row.
const std::vector<NodeId> kNodes{NodeId{10}, NodeId{11}, NodeId{12}, NodeId{13}};

Eigen::MatrixXd rowOfFour()
{
  Eigen::MatrixXd steps(4, 4);
  for (int to = 0; to < 4; ++to) {
    for (int from = 0; from < 4; ++from) {
      steps(to, from) = std::abs(to - from);
    }
  }
  return steps;
}

double total(const BayesLocalizer &localizer)
{
  return std::accumulate(localizer.belief().begin(), localizer.belief().end(), 0.0);
}

TEST(BayesLocalizer, startsEverywhereOrAtOnePlace)
{
  EXPECT_EQ(BayesLocalizer(kNodes).belief(), std::vector<double>(4, 0.25));
  EXPECT_EQ(BayesLocalizer(kNodes, NodeId{12}).belief(), (std::vector<double>{0, 0, 1, 0}));
}

TEST(BayesLocalizer, gaussianUpdateByHand)
{
  BayesLocalizer localizer(kNodes);
  const std::array<double, 4> seen{0.1, 0.2, 0.3, 0.4};
  localizer.observe(seen);
  const double variance = 0.0125; // of the four numbers
  const auto weight = [&](double d) { return std::exp(-d * d / (2.0 * variance)); };
  const double sum = weight(0.1) + weight(0.2) + weight(0.3) + weight(0.4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(localizer.belief()[i], weight(seen[i]) / sum, 1e-12);
  }
  EXPECT_EQ(localizer.mostProbable(), NodeId{10});
}

TEST(BayesLocalizer, publishedUpdateByHand)
{
  BayesLocalizer localizer(kNodes, std::nullopt, {.kernel = BayesKernel::Published});
  // 1, 2, 3, 4 counts of 20,000 pixels: variance 1.25.
  localizer.observe(std::array<double, 4>{5e-5, 1e-4, 1.5e-4, 2e-4});
  EXPECT_NEAR(localizer.belief()[1] / localizer.belief()[0], std::exp(-1.0 / 1.25), 1e-9);
  localizer.move(rowOfFour());
  EXPECT_NEAR(total(localizer), 1.0, 1e-12);
}

TEST(BayesLocalizer, motionSpreadsOverNeighboursFirst)
{
  BayesLocalizer localizer(kNodes, NodeId{10});
  localizer.move(rowOfFour());
  const std::vector<double> &belief = localizer.belief();
  EXPECT_NEAR(belief[1] / belief[0], std::exp(-0.5), 1e-12);
  EXPECT_NEAR(belief[2] / belief[0], std::exp(-2.0), 1e-12);
  EXPECT_NEAR(total(localizer), 1.0, 1e-12);
}

TEST(BayesLocalizer, noWayMeansNoProbability)
{
  Eigen::MatrixXd steps = rowOfFour();
  steps.row(3).setConstant(std::numeric_limits<double>::infinity());
  BayesLocalizer localizer(kNodes, NodeId{10});
  localizer.move(steps);
  EXPECT_DOUBLE_EQ(localizer.belief()[3], 0.0);
}

TEST(BayesLocalizer, historyOutvotesOneMisleadingView)
{
  BayesLocalizer localizer(kNodes);
  localizer.observe(std::array<double, 4>{0.01, 0.3, 0.3, 0.3});
  localizer.move(rowOfFour());
  localizer.observe(std::array<double, 4>{0.3, 0.01, 0.3, 0.3});
  localizer.move(rowOfFour());
  localizer.observe(std::array<double, 4>{0.3, 0.14, 0.3, 0.12}); // 13 looks best, 11 is near
  EXPECT_EQ(localizer.mostProbable(), NodeId{11});
}

TEST(BayesLocalizer, manyUnlikelyViewsLeaveADistribution)
{
  BayesLocalizer localizer(kNodes, NodeId{13}, {.kernel = BayesKernel::Published});
  for (int i = 0; i < 200; ++i) {
    localizer.observe(std::array<double, 4>{0.0, 1e-5, 2e-5, 1e-5});
  }
  EXPECT_NEAR(total(localizer), 1.0, 1e-12);
  EXPECT_EQ(localizer.mostProbable(), NodeId{13});
}

TEST(BayesLocalizer, equalDissimilaritiesChangeNothing)
{
  BayesLocalizer localizer(kNodes);
  localizer.observe(std::array<double, 4>{0.2, 0.2, 0.2, 0.2});
  EXPECT_EQ(localizer.belief(), std::vector<double>(4, 0.25));
}

TEST(BayesLocalizer, noticesThatItWasCarriedAwayAndFindsItsPlaceAgain)
{
  constexpr Eigen::Index kCount = 40;
  std::vector<NodeId> nodes;
  Eigen::MatrixXd steps(kCount, kCount);
  for (Eigen::Index to = 0; to < kCount; ++to) {
    nodes.push_back(NodeId{to});
    for (Eigen::Index from = 0; from < kCount; ++from) {
      steps(to, from) = static_cast<double>(std::abs(to - from));
    }
  }
  const auto seenAt = [&](Eigen::Index place) {
    std::vector<double> seen(static_cast<std::size_t>(kCount), 0.5);
    seen[static_cast<std::size_t>(place)] = 0.05;
    return seen;
  };
  for (const double kidnapping : {0.01, 0.0}) {
    BayesLocalizer localizer(nodes, NodeId{0}, {.kidnapping = kidnapping});
    for (Eigen::Index place = 0; place < 5; ++place) {
      localizer.observe(seenAt(place));
      EXPECT_LE(localizer.kidnapped(), 0.1);
      localizer.move(steps);
    }
    localizer.observe(seenAt(30)); // carried from 4
    const double noticed = localizer.kidnapped();
    localizer.move(steps);
    localizer.observe(seenAt(31));
    if (kidnapping > 0.0) {
      EXPECT_GT(noticed, 0.9);
      EXPECT_EQ(localizer.mostProbable(), NodeId{31});
      EXPECT_LT(localizer.kidnapped(), 0.5);
    }
    else {
      EXPECT_EQ(noticed, 0.0);
      EXPECT_NE(localizer.mostProbable(), NodeId{31});
    }
  }
}

TEST(BayesLocalizer, refusesBadInput)
{
  EXPECT_THROW(BayesLocalizer(kNodes, std::nullopt, {.kidnapping = 1.0}), LogicError);
  EXPECT_THROW(BayesLocalizer(kNodes, std::nullopt, {.publishedPixels = 0.0}), LogicError);
  EXPECT_THROW(BayesLocalizer({}), LogicError);
  EXPECT_THROW(BayesLocalizer(kNodes, NodeId{9}), LogicError);
  EXPECT_THROW(BayesLocalizer(kNodes, std::nullopt, {.motionSigma = 0.0}), LogicError);
  BayesLocalizer localizer(kNodes);
  EXPECT_THROW(localizer.move(Eigen::MatrixXd::Zero(3, 3)), LogicError);
  EXPECT_THROW(localizer.move(Eigen::MatrixXd::Constant(4, 4, -1.0)), LogicError);
  EXPECT_THROW(localizer.observe(std::array<double, 2>{0.1, 0.2}), LogicError);
  EXPECT_THROW(localizer.observe(std::array<double, 4>{0.1, 0.2, std::nan(""), 0.1}), LogicError);
}

} // namespace
} // namespace homeward
