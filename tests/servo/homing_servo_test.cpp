// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/servo/homing_servo.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace homeward
{
namespace
{

/** How the mirror stands on the robot, and how wrong the distance proxy is. */
struct LoopCase
{
  std::string name;
  double forward; ///< metres
  double yaw;     ///< rad
  double proxyFactor;
};

Pose2 planarMount(const LoopCase &loop)
{
  return {loop.forward, 0.0, loop.yaw};
}

Eigen::Isometry3d mount(const LoopCase &loop)
{
  Eigen::Isometry3d rMp = Eigen::Isometry3d::Identity();
  rMp.translate(Eigen::Vector3d(loop.forward, 0.0, 0.9));
  rMp.rotate(Eigen::AngleAxisd(loop.yaw, Eigen::Vector3d::UnitZ()));
  return rMp;
}

/** Home vector of the mirror at wMr * rMp towards `home`, exact but for the proxy's factor. */
HomeVector see(const Pose2 &wMr, const LoopCase &loop, const Eigen::Vector2d &home)
{
  const Eigen::Vector2d seen = (wMr * planarMount(loop)).inverse() * home;
  HomeVector vector;
  vector.direction = std::atan2(seen.y(), seen.x());
  vector.distanceProxy = loop.proxyFactor * seen.norm() / HomingServoOptions{}.landmarkRange;
  return vector;
}

TEST(HomingServo, homeOfTheRobotIsWhereItStoodAndNotItsMirror)
{
  const LoopCase loop{"aheadAndTurned", 0.2, radians(30.0), 1.0};
  const HomingServo servo(mount(loop));
  Random random(5, 1);
  for (int i = 0; i < 50; ++i) {
    const Pose2 home{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                     random.uniform(-3.0, 3.0)};
    const Pose2 here{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                     random.uniform(-3.0, 3.0)};
    HomeVector mirror = see(here, loop, (home * planarMount(loop)).translation());
    mirror.headingChange = wrapAngle(here.heading - home.heading);
    const HomeVector robot = servo.homeOfRobot(mirror, servo.options().landmarkRange);
    const Eigen::Vector2d rHome = here.inverse() * home.translation();
    EXPECT_NEAR(robot.distanceProxy * servo.options().landmarkRange, rHome.norm(), 1e-9);
    EXPECT_NEAR(wrapAngle(robot.direction + loop.yaw - std::atan2(rHome.y(), rHome.x())), 0.0,
                1e-9);
    EXPECT_EQ(robot.headingChange, mirror.headingChange);
  }
}

TEST(HomingServo, homeOfAMirrorInTheMiddleIsHomeOfTheRobot)
{
  const HomingServo servo(mount({"middle", 0.0, radians(30.0), 1.0}));
  const HomeVector seen{1.2, 0.3, -2.0, 0.7};
  const HomeVector home = servo.homeOfRobot(seen, 3.0);
  EXPECT_NEAR(home.direction, seen.direction, 1e-12);
  EXPECT_NEAR(home.distanceProxy * servo.options().landmarkRange, 3.0 * seen.distanceProxy, 1e-12);
}

class HomingLoop : public testing::TestWithParam<LoopCase>
{};

TEST_P(HomingLoop, convergesFromEverywhere)
{
  constexpr double kPeriod = 0.25; // s, of vision
  const LoopCase &loop = GetParam();
  HomingServo servo(mount(loop));
  const Eigen::Vector2d home = planarMount(loop).translation();
  for (std::uint32_t start = 0; start < 50; ++start) {
    Random random(17, start);
    const double distance = random.uniform(0.3, 3.0);
    const double away = random.uniform(-kPi, kPi);
    Pose2 wMr{distance * std::cos(away), distance * std::sin(away), random.uniform(-kPi, kPi)};
    double nearest = distance;
    double seconds = 0.0;
    for (; seconds < 120.0 && nearest > 0.05; seconds += kPeriod) {
      const HomeVector seen = see(wMr, loop, home);
      const Twist2 command = servo.approach(seen);
      ASSERT_GE(command.v, 0.0);
      ASSERT_LE(command.v, servo.options().speedMax + 1e-12);
      ASSERT_LE(std::abs(command.w), servo.options().turnRateMax + 1e-12);
      wMr = wMr * integrate(command, kPeriod);
      nearest = std::min(nearest, ((wMr * planarMount(loop)).translation() - home).norm());
    }
    EXPECT_LE(nearest, 0.05) << "start " << start << " after " << seconds << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Mounts, HomingLoop,
    testing::Values(LoopCase{"centred", 0.0, 0.0, 1.0}, LoopCase{"proxyThreeTimes", 0.0, 0.0, 3.0},
                    LoopCase{"proxyAThird", 0.0, 0.0, 1.0 / 3.0},
                    LoopCase{"aheadAndYawed", 0.2, radians(30.0), 1.0},
                    LoopCase{"aheadAndYawedProxyThreeTimes", 0.2, radians(30.0), 3.0},
                    LoopCase{"aheadAndYawedProxyAThird", 0.2, radians(30.0), 1.0 / 3.0},
                    LoopCase{"behind", -0.1, radians(180.0), 1.0}),
    [](const auto &instance) { return instance.param.name; });

TEST(HomingServo, turnsFirstWhenHomeIsAside)
{
  HomingServo servo(Eigen::Isometry3d::Identity());
  const Twist2 left = servo.approach({.direction = radians(100.0), .distanceProxy = 0.5});
  EXPECT_EQ(left.v, 0.0);
  EXPECT_GT(left.w, 0.0);
  const Twist2 right = servo.approach({.direction = radians(-170.0), .distanceProxy = 0.5});
  EXPECT_EQ(right.v, 0.0);
  EXPECT_LT(right.w, 0.0);
  EXPECT_GT(servo.approach({.direction = radians(55.0), .distanceProxy = 0.5}).v, 0.0);
}

TEST(HomingServo, lawOfACentredMirror)
{
  // v = gain share rho / cos(beta), w = gain (beta + share tan(beta))
  const HomingServoOptions options{.speedMax = 10.0, .turnRateMax = 10.0};
  HomingServo servo(Eigen::Isometry3d::Identity(), options);
  const double beta = 0.6;
  const double rho = 0.3 * options.landmarkRange;
  const Twist2 command = servo.approach({.direction = beta, .distanceProxy = 0.3});
  EXPECT_NEAR(command.v, options.gain * options.rangeShare * rho / std::cos(beta), 1e-9);
  EXPECT_NEAR(command.w, options.gain * (beta + options.rangeShare * std::tan(beta)), 1e-9);
}

TEST(HomingServo, leverArmIsCountedOnce)
{
  // Turning on the spot at w moves a mirror `forward` ahead of the axle sideways at w * forward:
  // the rates that the command causes must be the wanted ones.
  const HomingServoOptions options{.speedMax = 10.0, .turnRateMax = 10.0};
  const LoopCase loop{"", 0.2, radians(30.0), 1.0};
  HomingServo servo(mount(loop), options);
  const Eigen::Vector2d home(1.0, 0.45);
  const HomeVector before = see({}, loop, home);
  const double rho = before.distanceProxy * options.landmarkRange;
  const double step = 1e-6;
  const Twist2 command = servo.approach(before);
  const HomeVector after = see(integrate(command, step), loop, home);
  const double bearing = before.direction + loop.yaw;
  EXPECT_NEAR((after.direction - before.direction) / step, -options.gain * bearing, 1e-4);
  const double rhoRate = (after.distanceProxy * options.landmarkRange - rho) / step;
  EXPECT_NEAR(rhoRate, -options.gain * options.rangeShare * rho, 1e-4);
}

TEST(HomingServo, limitsKeepThePath)
{
  const HomeVector home{.direction = 0.5, .distanceProxy = 0.4};
  const Twist2 fast =
      HomingServo(Eigen::Isometry3d::Identity(), {.speedMax = 10.0, .turnRateMax = 10.0})
          .approach(home);
  const Twist2 slow =
      HomingServo(Eigen::Isometry3d::Identity(), {.speedMax = 0.05, .turnRateMax = 0.1})
          .approach(home);
  EXPECT_NEAR(slow.w / slow.v, fast.w / fast.v, 1e-9);
}

TEST(HomingServo, alignTurnsTheShortWay)
{
  HomingServo servo(mount({"", 0.2, radians(30.0), 1.0}));
  EXPECT_LT(servo.align(0.3).w, 0.0);
  EXPECT_GT(servo.align(-0.3).w, 0.0);
  EXPECT_GT(servo.align(radians(350.0)).w, 0.0);
  EXPECT_EQ(servo.align(0.3).v, 0.0);
  EXPECT_NEAR(servo.align(0.1).w, -0.1 * servo.options().gain, 1e-9);
}

TEST(HomingServo, refusesBadInput)
{
  const Eigen::Isometry3d rMp = Eigen::Isometry3d::Identity();
  EXPECT_THROW(HomingServo(rMp, {.gain = 0.0}), LogicError);
  EXPECT_THROW(HomingServo(rMp, {.rangeShare = 1.0}), LogicError);
  EXPECT_THROW(HomingServo(rMp, {.rangeMin = 2.0}), LogicError);
  EXPECT_THROW(HomingServo(rMp, {.turnFirst = radians(90.0)}), LogicError);
  EXPECT_THROW(HomingServo(rMp, {.speedMax = -1.0}), LogicError);
  HomingServo servo(rMp);
  EXPECT_THROW(servo.approach({.direction = std::numeric_limits<double>::quiet_NaN()}), LogicError);
  EXPECT_THROW(servo.align(std::numeric_limits<double>::infinity()), LogicError);
}

} // namespace
} // namespace homeward
