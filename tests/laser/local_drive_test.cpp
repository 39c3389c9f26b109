// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_world.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/laser/local_drive.h>
#include <homeward/laser/safety.h>

#include <gmock/gmock.h>

#include <limits>

namespace homeward
{
namespace
{

using ::testing::AnyOf;
using ::testing::Eq;
using ::testing::HasSubstr;

using State = LocalDrive::State;

const Footprint kRobot{};

/** The bases that every world is driven with: an ideal one, and a slow one that sees with noise. */
const std::vector<BaseModel> kBases{{}, {0.3, 0.5, 1.7, 0.01}};

/** Drives to the goal as a pilot would, and checks on the way what must hold on every tick. */
DriveLog drive(const PointWorld &world, const BaseModel &base, const Pose2 &start)
{
  const LocalDrive drive(kRobot, {});
  DriveTrial trial(world, kRobot, base);
  return trial.run(
      start, 60.0, [&](const std::vector<Eigen::Vector2d> &points, const Eigen::Vector2d &goal) {
        const double speed = std::clamp(goal.norm(), 0.1, 0.5);
        const auto decision = drive.choose(points, std::atan2(goal.y(), goal.x()), speed);
        EXPECT_GE(decision.twist.v, 0.0);
        EXPECT_LE(decision.twist.v, speed + 1e-12);
        EXPECT_LE(std::abs(decision.twist.w), 1.0 + 1e-12);
        return decision;
      });
}

/** Starts turned and shifted a little this way and that. */
std::vector<Pose2> startsAround(const PointWorld &world)
{
  std::vector<Pose2> starts;
  for (const double dy : {-0.15, 0.0, 0.08}) {
    for (const double heading : {-90.0, 0.0, 10.0, 180.0}) {
      starts.push_back({world.start.x, world.start.y + dy, radians(heading)});
    }
  }
  return starts;
}

/** The robot gets to the goal from everywhere near the start, without hunting left and right. */
void expectReached(const PointWorld &world, double longestPath)
{
  for (const BaseModel &base : kBases) {
    for (const Pose2 &start : startsAround(world)) {
      const DriveLog log = drive(world, base, start);
      EXPECT_EQ(log.end, DriveEnd::Reached)
          << "from y " << start.y << " heading " << degrees(start.heading) << " noise "
          << base.noise << ", at " << log.pose.x << " " << log.pose.y << " "
          << degrees(log.pose.heading) << " after " << log.seconds << " s";
      EXPECT_LT(log.path, longestPath);
      EXPECT_LE(log.turnReversals, 6);
    }
  }
}

/** A half turn of points at `range` around the robot, but for a gap. */
std::vector<Eigen::Vector2d> ring(double range)
{
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 360; ++i) {
    const double angle = radians(i);
    points.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return points;
}

TEST(LocalDrive, DrivesStraightOnWhenNothingIsInTheWay)
{
  const LocalDrive drive(kRobot, {});
  const auto decision = drive.choose({}, 0.0, 0.4);
  EXPECT_EQ(decision.state, State::Free);
  EXPECT_DOUBLE_EQ(decision.twist.v, 0.4);
  EXPECT_DOUBLE_EQ(decision.twist.w, 0.0);
}

TEST(LocalDrive, TurnsTowardsTheBearingAndOnTheSpotWhenItIsFarAside)
{
  const LocalDrive drive(kRobot, {});
  for (int degree = -180; degree < 180; degree += 3) {
    const double bearing = radians(degree);
    const auto decision = drive.choose({}, bearing, 0.4);
    EXPECT_EQ(decision.state, State::Free) << degree;
    if (std::abs(degree) > 60) {
      EXPECT_EQ(decision.twist.v, 0.0) << degree;
      EXPECT_NE(decision.twist.w, 0.0) << degree;
    }
    else {
      EXPECT_GT(decision.twist.v, 0.1) << degree;
    }
    if (degree % 180 != 0) {
      EXPECT_GT(decision.twist.w * bearing, 0.0) << degree;
    }
  }
}

TEST(LocalDrive, MirroredWorldsGetMirroredTwists)
{
  const LocalDrive drive(kRobot, {});
  Random random(11, 0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Eigen::Vector2d> points;
    std::vector<Eigen::Vector2d> mirrored;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector2d p(random.uniform(-1.0, 2.5), random.uniform(-1.5, 1.5));
      if (clearance({p}, kRobot) > 0.05) {
        points.push_back(p);
        mirrored.emplace_back(p.x(), -p.y());
      }
    }
    const double bearing = random.uniform(-2.0, 2.0);
    const auto a = drive.choose(points, bearing, 0.4);
    const auto b = drive.choose(mirrored, -bearing, 0.4);
    EXPECT_EQ(a.state, b.state);
    EXPECT_NEAR(a.twist.v, b.twist.v, 1e-9);
    EXPECT_NEAR(a.twist.w, -b.twist.w, 1e-9);
  }
}

TEST(LocalDrive, CommandsNothingThatAvoidWouldChangeAndCanAlwaysStopInTime)
{
  const LocalDrive drive(kRobot, {});
  Random random(12, 0);
  int moving = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 25; ++i) {
      const Eigen::Vector2d p(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
      if (clearance({p}, kRobot) > 0.0) {
        points.push_back(p);
      }
    }
    const auto decision = drive.choose(points, random.uniform(-kPi, kPi), 0.5);
    const Twist2 safe = avoid(points, kRobot, decision.twist);
    EXPECT_NEAR(safe.v, decision.twist.v, 1e-9);
    EXPECT_NEAR(safe.w, decision.twist.w, 1e-9);
    const double v = decision.twist.v;
    EXPECT_GE(freeTravel(points, kRobot, decision.twist, 1.0), v * v / (2.0 * 0.5));
    moving += v > 0.0 ? 1 : 0;
  }
  EXPECT_GT(moving, 300);
}

TEST(LocalDrive, SaysBlockedAndStandsWhenShutIn)
{
  const LocalDrive drive(kRobot, {});
  for (int degree = -180; degree < 180; degree += 15) {
    const auto decision = drive.choose(ring(0.45), radians(degree), 0.4);
    EXPECT_EQ(decision.state, State::Blocked) << degree;
    EXPECT_EQ(decision.twist.v, 0.0);
    EXPECT_EQ(decision.twist.w, 0.0);
  }
}

TEST(LocalDrive, TurnsTheOtherWayRoundWhenOneTouches)
{
  // The robot turns about its nose; a right turn would swing its tail into the post. The goal is
  // behind, on the right.
  //
  //                    *
  //     [robot.........o>
  //
  //     G
  const Footprint tail{-0.6, 0.1, -0.245, 0.245};
  const LocalDrive drive(tail, {});
  const std::vector<Eigen::Vector2d> points{{0.0, 0.5}};
  const auto decision = drive.choose(points, radians(-155.0), 0.4);
  EXPECT_NE(decision.state, State::Blocked);
  EXPECT_EQ(decision.twist.v, 0.0);
  EXPECT_GT(decision.twist.w, 0.0);
}

// A room and the next one, a door of 0.9 m between.
TEST(LocalDrive, PassesADoor)
{
  expectReached(PointWorld({"#############################################",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                                           #",
                            "#      S                           G        #",
                            "#                                           #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#############################################"}),
                6.0);
}

// The same, the goal off the door's axis, so that the straight way meets a door post.
TEST(LocalDrive, PassesADoorThatStandsAside)
{
  expectReached(PointWorld({"#############################################",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                                           #",
                            "#                                           #",
                            "#                                           #",
                            "#      S             #             G        #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#                    #                      #",
                            "#############################################"}),
                7.0);
}

// A pillar of 0.3 m straight ahead.
TEST(LocalDrive, GetsRoundAPillar)
{
  expectReached(PointWorld({"#############################################",
                            "#                                           #",
                            "#                                           #",
                            "#                                           #",
                            "#                                           #",
                            "#                                           #",
                            "#      S            ##            G         #",
                            "#                                           #",
                            "#                                           #",
                            "#                                           #",
                            "#                                           #",
                            "#############################################"}),
                6.0);
}

// A table of 0.9 m x 1.5 m in the middle of the room.
TEST(LocalDrive, GetsRoundATable)
{
  expectReached(PointWorld({"#################################################",
                            "#                                               #",
                            "#                                               #",
                            "#                                               #",
                            "#                                               #",
                            "#                    ######                     #",
                            "#                    ######                     #",
                            "#      S             ######            G        #",
                            "#                    ######                     #",
                            "#                    ######                     #",
                            "#                                               #",
                            "#                                               #",
                            "#                                               #",
                            "#                                               #",
                            "#################################################"}),
                8.0);
}

// A corridor of 1.5 m round a corner into one of 1.2 m: the walls lead to the goal.
TEST(LocalDrive, GetsRoundACorridorCorner)
{
  expectReached(PointWorld({"                  ##########", "                  #        #",
                            "                  #        #", "                  #   G    #",
                            "                  #        #", "                  #        #",
                            "                  #        #", "                  #        #",
                            "###################        #", "#                          #",
                            "#                          #", "#    S                     #",
                            "#                          #", "#                          #",
                            "############################"}),
                7.0);
}

// A corridor of 1.2 m that ends; the goal stands behind its wall.
TEST(LocalDrive, SaysBlockedInADeadEnd)
{
  const PointWorld world(
      {"##############################      ", "#                            #      ",
       "#                            #      ", "#    S                       #    G ",
       "#                            #      ", "##############################      "});
  for (const BaseModel &base : kBases) {
    for (const double heading : {-120.0, -45.0, 0.0, 60.0, 180.0}) {
      const DriveLog log = drive(world, base, {world.start.x, world.start.y, radians(heading)});
      EXPECT_EQ(log.end, DriveEnd::Blocked);
      EXPECT_GT(log.pose.x, 3.3) << "gave up early";
    }
  }
}

// Furniture everywhere; whatever happens, nothing is touched and no drive goes on for ever.
TEST(LocalDrive, NeverTouchesInACrowdedRoom)
{
  const PointWorld world({"#################################################",
                          "#                                               #",
                          "#                  ##                    #      #",
                          "#                  ##                           #",
                          "#     S                                ##       #",
                          "#             #             ####                #",
                          "#                           #                   #",
                          "#                                               #",
                          "#       ###                            #   G    #",
                          "#       #           ##                          #",
                          "#                   ##                          #",
                          "#                            ##                 #",
                          "#                            ##          ####   #",
                          "#        ##                                     #",
                          "#        ##        #                            #",
                          "#                                 ##            #",
                          "#################################################"});
  int reached = 0;
  for (const BaseModel &base : kBases) {
    for (int i = 0; i < 12; ++i) {
      const DriveLog log = drive(world, base, {world.start.x, world.start.y, radians(30.0 * i)});
      EXPECT_THAT(log.end, AnyOf(Eq(DriveEnd::Reached), Eq(DriveEnd::Blocked)))
          << i << " at " << log.pose.x << " " << log.pose.y << " " << degrees(log.pose.heading);
      reached += log.end == DriveEnd::Reached ? 1 : 0;
    }
  }
  EXPECT_GE(reached, 20);
}

TEST(LocalDrive, IsDeterministic)
{
  const LocalDrive drive(kRobot, {});
  const auto a = drive.choose(ring(1.2), 0.7, 0.4);
  const auto b = drive.choose(ring(1.2), 0.7, 0.4);
  EXPECT_EQ(a.twist.v, b.twist.v);
  EXPECT_EQ(a.twist.w, b.twist.w);
}

TEST(LocalDrive, RefusesBadOptionsByName)
{
  const auto refused = [](auto change, const char *name) {
    LocalDrive::Options options;
    change(options);
    try {
      const LocalDrive drive(kRobot, options);
      ADD_FAILURE() << name << " accepted";
    }
    catch (const LogicError &error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto &o) { o.maxSpeed = 0.0; }, "maxSpeed");
  refused([](auto &o) { o.maxTurnRate = -1.0; }, "maxTurnRate");
  refused([](auto &o) { o.minMargin = -0.1; }, "minMargin");
  refused([](auto &o) { o.margin = 0.01; }, "margin");
  refused([](auto &o) { o.minTravel = 0.1; }, "minTravel");
  refused([](auto &o) { o.maxDeflection = 2.0; }, "maxDeflection");
  refused([&](auto &o) { o.turnFirst = nan; }, "turnFirst");
  refused([](auto &o) { o.lookAhead = 0.0; }, "lookAhead");
  refused([](auto &o) { o.minHorizon = 0.1; }, "minHorizon");
  refused([](auto &o) { o.maxHorizon = 0.1; }, "maxHorizon");
  refused([&](auto &o) { o.turnCost = nan; }, "turnCost");
  EXPECT_THROW(LocalDrive({0.1, 0.1, -0.2, 0.2}, {}), LogicError);
  const LocalDrive drive(kRobot, {});
  EXPECT_THROW(drive.choose({}, nan, 0.3), LogicError);
  EXPECT_THROW(drive.choose({}, 0.0, -0.3), LogicError);
}

} // namespace
} // namespace homeward
