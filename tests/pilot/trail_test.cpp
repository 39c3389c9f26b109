// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/pilot/trail.h>

#include <gtest/gtest.h>

#include <vector>

namespace homeward
{
namespace
{

/** Drives twists of 0.1 s each and lays a trail. */
Pose2 drive(Trail &trail, Pose2 oMr, const Twist2 &twist, int ticks)
{
  for (int i = 0; i < ticks; ++i) {
    oMr = oMr * integrate(twist, 0.1);
    trail.add(oMr);
  }
  return oMr;
}

/** Follows the way back to its end; farthest a pose was from every pose in `way`, metres. */
double goBack(Trail &trail, Pose2 &oMr, const std::vector<Pose2> &way)
{
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const auto twist = trail.wayBack(oMr);
    if (!twist) {
      return worst;
    }
    EXPECT_LE(twist->v, 0.0) << "forwards on the way back";
    oMr = oMr * integrate(*twist, 0.1);
    double nearest = 1e9;
    for (const Pose2 &pose : way) {
      nearest = std::min(nearest, (pose.translation() - oMr.translation()).norm());
    }
    worst = std::max(worst, nearest);
  }
  ADD_FAILURE() << "the way back does not end";
  return worst;
}

TEST(Trail, LeadsBackRoundBendsAndTurnsOnTheSpot)
{
  const std::vector<std::pair<Twist2, int>> drives{
      {{0.4, 0.0}, 10}, {{0.3, 0.5}, 20}, {{0.0, -0.8}, 20}, {{0.4, -0.2}, 20}};
  Trail trail;
  Pose2 oMr{1.0, 2.0, 0.5};
  const Pose2 start = oMr;
  std::vector<Pose2> way{oMr};
  trail.add(oMr);
  for (const auto &[twist, ticks] : drives) {
    for (int i = 0; i < ticks; ++i) {
      oMr = drive(trail, oMr, twist, 1);
      way.push_back(oMr);
    }
  }
  const double worst = goBack(trail, oMr, way);
  EXPECT_LT(worst, 0.05);
  EXPECT_LT((oMr.translation() - start.translation()).norm(), 0.1);
  EXPECT_NEAR(wrapAngle(oMr.heading - start.heading), 0.0, 0.2);
}

TEST(Trail, EndsWhereItBegins)
{
  Trail trail;
  EXPECT_FALSE(trail.wayBack({}).has_value());
  Pose2 oMr = drive(trail, {}, {0.3, 0.0}, 10);
  goBack(trail, oMr, {Pose2{}, oMr});
  EXPECT_FALSE(trail.wayBack(oMr).has_value());
}

TEST(Trail, LeadsNowhereForARobotThatIsNotOnIt)
{
  Trail trail;
  drive(trail, {}, {0.3, 0.0}, 10);
  EXPECT_FALSE(trail.wayBack({5.0, 5.0, 0.0}).has_value());
}

} // namespace
} // namespace homeward
