// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/sim/simulator.h>
#include <homeward/sim/wheeled_base.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

constexpr Duration kStep = Simulator::kStep;

std::shared_ptr<const CollisionMap> mapOf(Scene scene)
{
  return std::make_shared<CollisionMap>(
      RayCaster(share(std::move(scene)), RayCaster::Layer::Collision), testRobot());
}

/** A room of 20 m x 20 m. */
std::shared_ptr<const CollisionMap> hall()
{
  static const std::shared_ptr<const CollisionMap> map = mapOf(makeRoom(20.0F, 20.0F));
  return map;
}

/** A base in a world, driven by hand. */
class Driven
{
public:
  Driven(std::shared_ptr<const CollisionMap> map, const Pose2 &start, const DriveErrors &errors,
         std::uint64_t seed = 1)
      : base(std::move(map), kPioneer3AtLimits, errors, seed, start)
  {}

  /** Drives at `twist` for `seconds`, commanding ten times a second. */
  void drive(const Twist2 &twist, double seconds)
  {
    for (int i = 0; i * toSeconds(kStep) < seconds - 1e-9; ++i) {
      if (i % 5 == 0) {
        base.command(now, twist);
      }
      coast();
    }
  }

  void coast(int steps = 1)
  {
    for (int i = 0; i < steps; ++i) {
      base.step(now, kStep);
      now += kStep;
    }
  }

  Time now{};
  WheeledBase base;
};

constexpr DriveErrors kPerfect{0.0, 0.0, 0.0};

TEST(WheeledBase, reachesTheVelocityAtTheRateOfItsLimits)
{
  Driven robot(hall(), {5.0, 5.0, 0.0}, kPerfect);
  robot.drive({0.3, 0.0}, 0.5);
  EXPECT_NEAR(robot.base.velocity().v, 0.15, 1e-6);
  robot.drive({0.3, 0.0}, 1.0);
  EXPECT_NEAR(robot.base.velocity().v, 0.3, 1e-9);
  robot.drive({0.0, 0.0}, 0.3);
  EXPECT_NEAR(robot.base.velocity().v, 0.15, 1e-6);
  robot.drive({-9.0, 9.0}, 9.0);
  EXPECT_NEAR(robot.base.velocity().v, -kPioneer3AtLimits.maxSpeed, 1e-9);
  EXPECT_NEAR(robot.base.velocity().w, kPioneer3AtLimits.maxTurnRate, 1e-9);
}

TEST(WheeledBase, withoutErrorsOdometryIsTheTruth)
{
  Driven robot(hall(), {5.0, 5.0, 0.7}, kPerfect);
  robot.drive({0.4, 0.3}, 6.0);
  robot.drive({-0.2, -0.5}, 3.0);
  const Pose2 expected = Pose2{5.0, 5.0, 0.7} * robot.base.odometry();
  EXPECT_NEAR(robot.base.pose().x, expected.x, 1e-9);
  EXPECT_NEAR(robot.base.pose().y, expected.y, 1e-9);
  EXPECT_NEAR(robot.base.pose().heading, expected.heading, 1e-9);
}

TEST(WheeledBase, odometryDriftsAFewPercentAndDiffersWithTheSeed)
{
  const auto turned = [](std::uint64_t seed) {
    Driven robot(hall(), {5.0, 5.0, 0.0}, {}, seed);
    robot.drive({0.0, 0.5}, 12.0);
    return wrapAngle(robot.base.pose().heading - robot.base.odometry().heading) / 6.0;
  };
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    squares += turned(seed) * turned(seed);
  }
  const double typical = std::sqrt(squares / 30.0);
  EXPECT_GT(typical, 0.015);
  EXPECT_LT(typical, 0.08);
  EXPECT_EQ(turned(3), turned(3));
  EXPECT_NE(turned(3), turned(4));
}

TEST(WheeledBase, stopsWithoutCommandsOnlyAfterTheWatchdog)
{
  Driven robot(hall(), {5.0, 5.0, 0.0}, kPerfect);
  robot.drive({0.3, 0.0}, 2.0); // the last command comes 0.1 s before the end
  robot.coast(24);
  EXPECT_NEAR(robot.base.velocity().v, 0.3, 1e-9);
  robot.coast(50);
  EXPECT_EQ(robot.base.velocity().v, 0.0);
  const Pose2 stood = robot.base.pose();
  robot.coast(50);
  EXPECT_EQ(robot.base.pose().x, stood.x);
}

TEST(WheeledBase, neverEntersAWallAndSaysThatItIsHeld)
{
  Driven robot(mapOf(makeRoom(4.0F, 4.0F)), {2.0, 2.0, 0.0}, kPerfect);
  robot.drive({0.4, 0.0}, 3.0);
  EXPECT_FALSE(robot.base.stalled());
  robot.drive({0.4, 0.0}, 5.0);
  EXPECT_TRUE(robot.base.stalled());
  EXPECT_LE(robot.base.pose().x, 4.0 - 0.25 + 0.02);
  EXPECT_GT(robot.base.pose().x, 4.0 - 0.25 - 0.04);
  const double held = robot.base.odometry().x;
  robot.drive({0.4, 0.0}, 2.0);
  EXPECT_NEAR(robot.base.odometry().x, held, 0.01);
  robot.drive({0.0, 0.0}, 0.2);
  EXPECT_FALSE(robot.base.stalled());
  robot.drive({-0.4, 0.0}, 2.0);
  EXPECT_LT(robot.base.pose().x, 3.5);
}

TEST(WheeledBase, oneRunIntoAWallIsOneCollisionHoweverLongItPushes)
{
  Driven robot(mapOf(makeRoom(4.0F, 4.0F)), {2.0, 2.0, 0.0}, kPerfect);
  robot.drive({0.4, 0.0}, 20.0);
  EXPECT_EQ(robot.base.contacts().collisions(), 1);
  EXPECT_EQ(robot.base.contacts().unseenContacts(), 0);
  robot.drive({-0.4, 0.0}, 4.0);
  robot.drive({0.4, 0.0}, 6.0);
  EXPECT_EQ(robot.base.contacts().collisions(), 2);
}

TEST(WheeledBase, creepingContactIsNoCollision)
{
  Driven robot(mapOf(makeRoom(4.0F, 4.0F)), {3.6, 2.0, 0.0}, kPerfect);
  robot.drive({0.04, 0.0}, 10.0);
  EXPECT_TRUE(robot.base.stalled());
  EXPECT_EQ(robot.base.contacts().collisions(), 0);
}

TEST(WheeledBase, runIntoATableTopIsCountedApart)
{
  Scene scene = makeRoom(6.0F, 4.0F);
  addBox(scene, {3.0F, 1.0F, 0.60F}, {4.0F, 3.0F, 0.65F});
  Driven robot(mapOf(std::move(scene)), {2.0, 2.0, 0.0}, kPerfect);
  robot.drive({0.4, 0.0}, 8.0);
  EXPECT_EQ(robot.base.contacts().collisions(), 0);
  EXPECT_EQ(robot.base.contacts().unseenContacts(), 1);
}

TEST(WheeledBase, turningIntoAWallCollidesWithTheCorner)
{
  Driven robot(mapOf(makeRoom(4.0F, 4.0F)), {3.72, 2.0, 0.0}, kPerfect);
  robot.drive({0.0, 1.0}, 3.0);
  EXPECT_EQ(robot.base.contacts().collisions(), 1);
  EXPECT_LT(robot.base.pose().heading, radians(30.0));
}

TEST(WheeledBase, drivenDistanceIsTheLengthOfThePath)
{
  Driven robot(hall(), {5.0, 5.0, 0.0}, kPerfect);
  robot.drive({0.4, 0.4}, 10.0);
  robot.drive({-0.4, 0.0}, 4.0);
  // Ramps: 0.3 m/s^2 up, 0.5 m/s^2 down through zero.
  const double up = 0.4 * 10.0 - 0.4 * 0.4 / (2.0 * 0.3);
  const double back = 0.4 * 0.4 / (2.0 * 0.5) + 0.4 * (4.0 - 0.8) - 0.4 * 0.4 / (2.0 * 0.3);
  EXPECT_NEAR(robot.base.distance(), up + back, 0.03);
}

TEST(WheeledBase, refusesAVelocityThatIsNoNumber)
{
  Driven robot(mapOf(makeRoom(4.0F, 4.0F)), {2.0, 2.0, 0.0}, kPerfect);
  EXPECT_THROW(robot.base.command(robot.now, {std::nan(""), 0.0}), LogicError);
}

} // namespace
} // namespace homeward
