// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_world.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/laser/safety.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using ::testing::HasSubstr;

const Footprint kRobot{};

/** A wall across the way, `ahead` metres before the front, turned by `slant`. */
std::vector<Eigen::Vector2d> wall(double ahead, double slant)
{
  std::vector<Eigen::Vector2d> points;
  for (double along = -2.0; along <= 2.0; along += 0.03) {
    points.emplace_back(kRobot.xMax + ahead - along * std::sin(slant), along * std::cos(slant));
  }
  return points;
}

/** Two door posts `width` apart, `thick` metres long, the robot between them. */
std::vector<Eigen::Vector2d> door(double width, double thick)
{
  std::vector<Eigen::Vector2d> points;
  for (double x = -thick / 2.0; x <= thick / 2.0; x += 0.03) {
    points.emplace_back(x, width / 2.0);
    points.emplace_back(x, -width / 2.0);
  }
  return points;
}

TEST(StoppableSpeed, StopsInExactlyTheDistance)
{
  for (const double distance : {0.01, 0.2, 1.0}) {
    for (const double reaction : {0.0, 0.15, 0.5}) {
      const double v = stoppableSpeed(distance, 0.5, reaction);
      EXPECT_NEAR(v * reaction + v * v / (2.0 * 0.5), distance, 1e-12);
    }
  }
  EXPECT_EQ(stoppableSpeed(0.0, 0.5, 0.1), 0.0);
  EXPECT_EQ(stoppableSpeed(-1.0, 0.5, 0.1), 0.0);
}

TEST(Avoid, LeavesAFreeWayAsItIs)
{
  for (const Twist2 wanted : {Twist2{0.5, 0.0}, Twist2{0.3, -0.8}, Twist2{-0.2, 0.1},
                              Twist2{0.0, 1.0}, Twist2{0.0, 0.0}}) {
    const Twist2 safe = avoid(wall(3.0, 0.0), kRobot, wanted);
    EXPECT_EQ(safe.v, wanted.v);
    EXPECT_EQ(safe.w, wanted.w);
  }
}

TEST(Avoid, SlowsDownOnTheSameArc)
{
  const Twist2 wanted{0.7, 0.1};
  const Twist2 safe = avoid(wall(0.3, 0.0), kRobot, wanted);
  EXPECT_GT(safe.v, 0.0);
  EXPECT_LT(safe.v, wanted.v);
  EXPECT_NEAR(safe.w / safe.v, wanted.w / wanted.v, 1e-12);
}

TEST(Avoid, TurnsAwayFromWhatIsNearerThan20Centimetres)
{
  // A wall slanted so that its left part is the nearer one, and the other way about.
  const Twist2 right = avoid(wall(0.18, radians(10.0)), kRobot, {0.3, 0.0});
  EXPECT_EQ(right.v, 0.0);
  EXPECT_LT(right.w, 0.0);
  const Twist2 left = avoid(wall(0.18, radians(-10.0)), kRobot, {0.3, 0.0});
  EXPECT_EQ(left.v, 0.0);
  EXPECT_GT(left.w, 0.0);
  EXPECT_GT(avoid(wall(0.25, 0.0), kRobot, {0.3, 0.0}).v, 0.0);
}

TEST(Avoid, GoesOnTurningToTheSideItHasBegunWith)
{
  std::vector<Eigen::Vector2d> points = wall(0.18, 0.0);
  const Twist2 first = avoid(points, kRobot, {0.3, 0.0});
  ASSERT_NE(first.w, 0.0);
  double turned = 0.0;
  while (turned < radians(60.0)) {
    const Pose2 step{0.0, 0.0, first.w * 0.1};
    for (Eigen::Vector2d &p : points) {
      p = step.inverse() * p;
    }
    turned += std::abs(step.heading);
    const Twist2 next = avoid(points, kRobot, {0.3, 0.0});
    if (next.v > 0.0) {
      return;
    }
    ASSERT_GT(next.w * first.w, 0.0) << "after " << degrees(turned);
  }
  // Seen more and more from aside, the wall stays across the way until the robot is along it.
  EXPECT_LT(turned, radians(90.0));
}

TEST(Avoid, LetsTheRobotThroughADoorOf60Centimetres)
{
  const Twist2 wanted{0.3, 0.0};
  const Twist2 safe = avoid(door(0.6, 0.8), kRobot, wanted);
  EXPECT_EQ(safe.v, wanted.v);
  EXPECT_EQ(safe.w, wanted.w);
}

TEST(Avoid, StopsWhereNeitherSideIsFreeToTurn)
{
  std::vector<Eigen::Vector2d> points = door(0.52, 0.9);
  points.emplace_back(0.35, 0.0);
  const Twist2 safe = avoid(points, kRobot, {0.3, 0.0});
  EXPECT_EQ(safe.v, 0.0);
  EXPECT_EQ(safe.w, 0.0);
}

TEST(Avoid, StopsATurnThatWouldTouch)
{
  const std::vector<Eigen::Vector2d> points{{0.22, 0.262}};
  EXPECT_EQ(avoid(points, kRobot, {0.0, 1.0}).w, 0.0);
  EXPECT_EQ(avoid(points, kRobot, {0.0, 1.0}).v, 0.0);
}

TEST(Avoid, GuardsTheBackOfWhoDrivesBackwards)
{
  const std::vector<Eigen::Vector2d> points{{-0.35, 0.0}};
  EXPECT_EQ(avoid(points, kRobot, {-0.3, 0.0}).v, 0.0);
  EXPECT_EQ(avoid(points, kRobot, {0.3, 0.0}).v, 0.3);
}

TEST(Avoid, ChangesNothingTheSecondTime)
{
  Random random(21, 0);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 15; ++i) {
      const Eigen::Vector2d p(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2));
      if (clearance({p}, kRobot) > 0.0) {
        points.push_back(p);
      }
    }
    const Twist2 once = avoid(points, kRobot, {random.uniform(-0.5, 0.7), random.uniform(-1, 1)});
    const Twist2 twice = avoid(points, kRobot, once);
    EXPECT_NEAR(twice.v, once.v, 1e-12);
    EXPECT_NEAR(twice.w, once.w, 1e-12);
  }
}

// A closed room full of posts.
TEST(Avoid, AloneKeepsABlindWandererFromTouching)
{
  const PointWorld world({"##############################", "#                            #",
                          "#            ##              #", "#                            #",
                          "#                      #     #", "#     S                      #",
                          "#                            #", "#               #            #",
                          "#        #                   #", "#                            #",
                          "#                       ##   #", "#                            #",
                          "##############################"});
  double path = 0.0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    Random random(5, seed);
    DriveTrial trial(world, kRobot, {0.3, 0.5, 1.7, 0.005});
    Twist2 wish;
    int tick = 0;
    const DriveLog log = trial.run(
        world.start, 60.0,
        [&](const std::vector<Eigen::Vector2d> &points, const Eigen::Vector2d &) {
          if (tick++ % 20 == 0) {
            wish = {std::max(0.0, random.uniform(-0.2, 0.6)), random.uniform(-0.6, 0.6)};
          }
          return LocalDrive::Decision{avoid(points, kRobot, wish), LocalDrive::State::Free};
        });
    EXPECT_EQ(log.end, DriveEnd::TimeOut) << "at " << log.pose.x << " " << log.pose.y;
    path += log.path;
  }
  EXPECT_GT(path, 6.0);
}

TEST(Creep, LeavesTheTwistAloneWhereNothingIsNear)
{
  const Twist2 wanted{0.3, 0.4};
  const Twist2 far = creep({{0.50, 0.0}, {0.0, -0.5}}, Footprint{}, wanted);
  EXPECT_EQ(far.v, wanted.v);
  EXPECT_EQ(far.w, wanted.w);
}

TEST(Creep, SlowsThePartThatPassesAndKeepsTheArc)
{
  const Twist2 wanted{0.2, 0.4};
  const Eigen::Vector2d beside(0.25, -0.30); // off the corner ahead on the right
  const Twist2 slow = creep({beside}, Footprint{}, wanted);
  EXPECT_NEAR(std::hypot(slow.v + slow.w * 0.245, slow.w * 0.25), 0.04, 1e-12);
  EXPECT_NEAR(slow.v / slow.w, wanted.v / wanted.w, 1e-12);
  const Twist2 crawl{0.01, 0.0};
  EXPECT_EQ(creep({beside}, Footprint{}, crawl).v, crawl.v);
}

TEST(Creep, SlowsBeforeItIsNear)
{
  const Twist2 wanted{0.3, 0.0};
  const Eigen::Vector2d ahead(0.25 + 0.15, 0.2);
  EXPECT_NEAR(creep({ahead}, Footprint{}, wanted).v, CreepOptions{}.speed, 1e-12);
  const CreepOptions blind{.ahead = 0.0};
  EXPECT_EQ(creep({ahead}, Footprint{}, wanted, blind).v, wanted.v);
}

TEST(Creep, RefusesASpeedOfNothing)
{
  EXPECT_THROW(creep({}, Footprint{}, {0.1, 0.0}, {.speed = 0.0}), LogicError);
}

TEST(Avoid, RefusesBadOptionsByName)
{
  const auto refused = [](const AvoidOptions &options, const char *name) {
    try {
      avoid({}, kRobot, {0.1, 0.0}, options);
      ADD_FAILURE() << name << " accepted";
    }
    catch (const LogicError &error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
  };
  refused({.nearDistance = 0.0}, "nearDistance");
  refused({.margin = -0.1}, "margin");
  refused({.turnAngle = -1.0}, "turnAngle");
  refused({.turnRate = 0.0}, "turnRate");
  refused({.deceleration = 0.0}, "deceleration");
  refused({.turnDeceleration = 0.0}, "turnDeceleration");
  refused({.reaction = -0.1}, "reaction");
  EXPECT_THROW(avoid({}, kRobot, {std::nan(""), 0.0}), LogicError);
}

} // namespace
} // namespace homeward
