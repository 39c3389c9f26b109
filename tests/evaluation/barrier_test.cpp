// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/barrier.h>
#include <homeward/evaluation/barrier_meetings.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

constexpr double kClear = 0.5;

TEST(Barrier, standsAcrossTheMiddleOfTheWay)
{
  const Barrier barrier = barrierAcross({1.0, 1.0}, {1.0, 3.0}, {{1.0, 1.0}, {1.0, 3.0}}).value();
  EXPECT_EQ(barrier.width, 3.0);
  EXPECT_NEAR(barrier.distanceTo({1.0, 1.0}), 0.9, 1e-12);
  EXPECT_NEAR(barrier.distanceTo({1.0, 3.0}), 0.9, 1e-12);
  EXPECT_EQ(barrier.distanceTo({2.4, 2.0}), 0.0) << "within";
  EXPECT_NEAR(barrier.distanceTo({2.8, 2.5}), 0.5, 1e-12) << "0.3 m and 0.4 m from a corner";
}

TEST(Barrier, isAsWideAsLeavesEveryPlaceHalfAMetre)
{
  for (double angle = -3.0; angle < 3.0; angle += 0.25) {
    const Eigen::Rotation2Dd turned(angle);
    const Eigen::Vector2d from(0.4, -7.0);
    const Eigen::Vector2d to = from + turned * Eigen::Vector2d(2.0, 0.0);
    const Eigen::Vector2d beside = from + turned * Eigen::Vector2d(1.3, 1.2);
    const std::vector<Eigen::Vector2d> places{from, to, beside};
    const Barrier barrier = barrierAcross(from, to, places).value();
    EXPECT_LT(barrier.width, 3.0);
    EXPECT_NEAR(barrier.distanceTo(beside), kClear, 1e-9);
  }
}

TEST(Barrier, thereIsNoneWhereItIsTooNarrowOrTheWayTooShort)
{
  EXPECT_TRUE(barrierAcross({0.0, 0.0}, {1.31, 0.0}, {}));
  EXPECT_FALSE(barrierAcross({0.0, 0.0}, {1.29, 0.0}, {}));
  EXPECT_TRUE(barrierAcross({0.0, 0.0}, {2.0, 0.0}, {{1.0, 1.01}}));
  EXPECT_FALSE(barrierAcross({0.0, 0.0}, {2.0, 0.0}, {{1.0, 0.99}}));
  EXPECT_FALSE(barrierAcross({0.0, 0.0}, {2.0, 0.0}, {{1.0, 0.0}}));
}

TEST(Barrier, isABoxToSeeAndTouch)
{
  const Barrier barrier = barrierAcross({0.0, 5.0}, {2.0, 5.0}, {}).value();
  const std::shared_ptr<const Scene> scene = barrier.scene();
  for (const std::vector<Mesh> *meshes : {&scene->visuals, &scene->collisions}) {
    const Eigen::AlignedBox3f box = boundsOf(*meshes);
    EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(0.9F, 3.5F, 0.0F), 1e-5F));
    EXPECT_TRUE(box.max().isApprox(Eigen::Vector3f(1.1F, 6.5F, 1.2F), 1e-5F));
  }
  const Barrier oblique = barrierAcross({0.0, 0.0}, {2.0, 1.0}, {}).value();
  const Mesh mesh = oblique.scene()->collisions.front();
  for (const Eigen::Vector3f &vertex : mesh.vertices) {
    EXPECT_NEAR(oblique.distanceTo(vertex.head<2>().cast<double>()), 0.0, 1e-5);
  }
}

/** A navigation, told in words. */
struct Told
{
  using Phase = NavigatorState::Phase;

  void step(double seconds, Phase phase, std::int64_t from = 0, std::int64_t to = 1)
  {
    NavigatorState state;
    state.phase = phase;
    state.here = NodeId{from};
    state.route = {NodeId{to}, NodeId{9}};
    meetings.note(Time(fromSeconds(seconds)), state);
  }

  void gap(double seconds, double metres) { meetings.note(Time(fromSeconds(seconds)), metres); }

  BarrierMeetings meetings;
};

using Phase = NavigatorState::Phase;

TEST(BarrierMeetings, lastFromTheFirstApproachToTheWayBack)
{
  Told told;
  told.step(0.0, Phase::Following);
  told.gap(1.0, 0.7);
  told.gap(2.0, 0.59);
  told.gap(3.0, 0.8); // it has backed out
  told.gap(4.0, 0.3);
  told.step(12.0, Phase::Returning);
  EXPECT_THAT(told.meetings.seconds(), testing::ElementsAre(10.0));
}

TEST(BarrierMeetings, goOnWhileTheSameLegIsTried)
{
  Told told;
  told.step(0.0, Phase::Following);
  told.gap(1.0, 0.2);
  told.step(10.0, Phase::Locating);
  told.step(10.0, Phase::Approaching);
  told.step(20.0, Phase::Striding);
  told.step(30.0, Phase::Following);
  EXPECT_THAT(told.meetings.seconds(), testing::IsEmpty());
  told.step(61.0, Phase::Finished);
  EXPECT_THAT(told.meetings.seconds(), testing::ElementsAre(60.0));
}

TEST(BarrierMeetings, eachLegMeetsItAnew)
{
  Told told;
  told.gap(0.0, 0.1);
  told.step(1.0, Phase::Locating);
  told.gap(1.5, 0.1); // on no leg yet
  told.step(2.0, Phase::Following, 0, 1);
  told.gap(2.0, 0.1);
  told.step(5.0, Phase::Following, 0, 2);
  told.gap(6.0, 0.1);
  told.step(7.0, Phase::Following, 2, 1);
  told.gap(8.0, 0.9);
  told.step(9.0, Phase::Finished);
  EXPECT_THAT(told.meetings.seconds(), testing::ElementsAre(3.0, 1.0));
}

} // namespace
} // namespace homeward
