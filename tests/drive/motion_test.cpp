// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/pilot/motion.h>
#include <homeward/sim/simulator.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** A robot in the simulator with the control loop round it. */
class Driven
{
public:
  Driven(Scene scene, const Pose2 &start)
      : m_simulator(share(std::move(scene)), testRobot(), testCamera(), optionsAt(start)),
        motion({m_simulator.clock(), m_simulator.base(), m_simulator.laser(), m_simulator.camera()},
               testRobot(), {}, stop)
  {
    motion.tick();
  }

  Truth truth() const { return m_simulator.truth(); }

  /** Steers for so many ticks towards a point `ahead` metres straight ahead of the start. */
  void goAhead(int ticks, double ahead, Motion::Room room = Motion::Room::Ample)
  {
    for (int i = 0; i < ticks; ++i) {
      const Eigen::Vector2d goal = motion.pose().inverse() * Eigen::Vector2d(ahead, 0.0);
      motion.steer(std::atan2(goal.y(), goal.x()), 0.5, room);
      motion.tick();
    }
  }

private:
  static SimulatorOptions optionsAt(const Pose2 &start)
  {
    SimulatorOptions options;
    options.start = start;
    return options;
  }

  Simulator m_simulator;

public:
  std::atomic<bool> stop = false;
  Motion motion;
};

TEST(Motion, TurnsToAHeading)
{
  Driven robot(makeRoom(4.0F, 4.0F), {2.0, 2.0, 0.0});
  EXPECT_TRUE(robot.motion.turnTo(2.5));
  EXPECT_NEAR(robot.motion.pose().heading, 2.5, 0.06);
  EXPECT_NEAR(robot.motion.sight().base.velocity.w, 0.0, 0.02);
}

TEST(Motion, KnowsWhereTheRobotWasAndWillBe)
{
  Driven robot(makeRoom(8.0F, 4.0F), {1.0, 2.0, 0.0});
  robot.goAhead(30, 20.0);
  const Pose2 before = robot.motion.pose();
  const Time then = robot.motion.sight().base.stamp;
  robot.goAhead(1, 20.0);
  const Pose2 after = robot.motion.pose();
  const Time now = robot.motion.sight().base.stamp;
  const double step = after.x - before.x;
  ASSERT_GT(step, 0.02);
  EXPECT_EQ(robot.motion.poseAt(then).x, before.x);
  EXPECT_EQ(robot.motion.poseAt(now).x, after.x);
  EXPECT_NEAR(robot.motion.poseAt(then + (now - then) / 4).x, before.x + step / 4.0, 0.1 * step);
  EXPECT_NEAR(robot.motion.poseAt(now + (now - then)).x, after.x + step, 0.2 * step);
  EXPECT_LT(robot.motion.poseAt(now - std::chrono::seconds(60)).x, before.x); // the oldest known
}

/** A camera that runs by itself and has sent nothing since a given instant. */
class CameraSilentSince final : public ImageSource
{
public:
  explicit CameraSilentSince(Time since) : m_since(since) {}
  std::optional<Frame> grab() override { return Frame{m_since, {}}; }
  std::optional<Time> newest() const override { return m_since; }

private:
  Time m_since;
};

TEST(Motion, StandsAndGivesUpWhenACameraThatRanByItselfIsSilent)
{
  SimulatorOptions options;
  options.start = Pose2{1.0, 2.0, 0.0};
  Simulator simulator(share(makeRoom(8.0F, 4.0F)), testRobot(), testCamera(), options);
  CameraSilentSince camera(simulator.clock().now() + std::chrono::seconds(2));
  const std::atomic<bool> stop = false;
  Motion motion({simulator.clock(), simulator.base(), simulator.laser(), camera}, testRobot(), {},
                stop);
  EXPECT_THROW(
      {
        while (true) {
          motion.tick();
          motion.follow({0.3, 0.0}, 0.0);
        }
      },
      DeviceError);
  EXPECT_EQ(simulator.base().state().velocity.v, 0.0);
  // 2 s and 0.5 s of silence driven, 5 s waited for.
  EXPECT_NEAR(toSeconds(simulator.clock().now()), 7.6, 0.3);
  EXPECT_LT(simulator.truth().distance, 0.9);
}

TEST(Motion, TurnsTheLongWayWhereTheShortOneIsBarred)
{
  // Wall on the left, 15 cm beside the body; turning left by 120 degrees the back corner meets it
  // as well as turning right, so the robot backs out or says that it cannot.
  Scene scene = makeRoom(6.0F, 2.0F);
  Driven robot(std::move(scene), {3.0, 1.6, 0.0});
  robot.motion.turnTo(radians(120.0));
  EXPECT_EQ(robot.truth().collisions, 0);
}

TEST(Motion, DrivesRoundABoxWithoutTouchingIt)
{
  Scene scene = makeRoom(8.0F, 4.0F);
  addBox(scene, {3.5F, 1.6F, 0.0F}, {4.0F, 2.3F, 1.0F});
  Driven robot(std::move(scene), {1.0, 2.0, 0.0});
  robot.goAhead(200, 20.0);
  EXPECT_GT(robot.truth().pose.x, 6.5);
  EXPECT_EQ(robot.truth().collisions, 0);
  EXPECT_NEAR(robot.motion.travelled(), robot.truth().distance, 0.3);
}

TEST(Motion, TakesATightWayOnlyWhereItIsKnownToLeadOn)
{
  const auto reached = [](Motion::Room room) {
    Scene scene = makeRoom(6.0F, 4.0F);
    // A door of 0.62 m for a body of 0.49 m.
    addBox(scene, {3.0F, 0.0F, 0.0F}, {3.2F, 1.69F, 2.0F});
    addBox(scene, {3.0F, 2.31F, 0.0F}, {3.2F, 4.0F, 2.0F});
    Driven robot(std::move(scene), {1.5, 2.0, 0.0});
    robot.goAhead(400, 2.6, room);
    EXPECT_EQ(robot.truth().collisions, 0);
    return robot.truth().pose.x;
  };
  EXPECT_LT(reached(Motion::Room::Ample), 3.0);
  EXPECT_GT(reached(Motion::Room::Tight), 3.6);
}

TEST(Motion, CreepsPastWhatIsNear)
{
  Scene scene = makeRoom(6.0F, 4.0F);
  // A door of 0.62 m: 6.5 cm on both sides of the body.
  addBox(scene, {3.0F, 0.0F, 0.0F}, {3.2F, 1.69F, 2.0F});
  addBox(scene, {3.0F, 2.31F, 0.0F}, {3.2F, 4.0F, 2.0F});
  Driven robot(std::move(scene), {1.5, 2.0, 0.0});
  double before = 0.0; // fastest where nothing is near
  double within = 0.0; // fastest with the middle of the body between the posts
  for (int i = 0; i < 400; ++i) {
    robot.goAhead(1, 2.6, Motion::Room::Tight);
    const double x = robot.truth().pose.x;
    const double speed = robot.motion.sight().base.velocity.v;
    before = x < 2.0 ? std::max(before, speed) : before;
    within = x > 3.05 && x < 3.15 ? std::max(within, speed) : within;
  }
  EXPECT_GT(robot.truth().pose.x, 3.6);
  EXPECT_GT(before, 0.2);
  EXPECT_GT(within, 0.01);
  EXPECT_LT(within, 0.06);
}

TEST(Motion, BacksOutAlongTheWayItCame)
{
  Driven robot(makeRoom(6.0F, 4.0F), {1.0, 2.0, 0.0});
  robot.goAhead(40, 20.0);
  robot.motion.stop();
  const double before = robot.truth().pose.x;
  ASSERT_GT(before, 2.0);
  EXPECT_TRUE(robot.motion.retrace(0.6));
  EXPECT_NEAR(robot.truth().pose.x, before - 0.6, 0.12);
  EXPECT_NEAR(robot.motion.sight().base.velocity.v, 0.0, 0.02);
}

TEST(Motion, HasNoWayBackBeforeItHasDriven)
{
  Driven robot(makeRoom(6.0F, 4.0F), {1.0, 2.0, 0.0});
  EXPECT_FALSE(robot.motion.retrace(0.6));
}

TEST(Motion, HeldByWhatItsLaserMissesItFreesItselfAndGoesRound)
{
  Scene scene = makeRoom(6.0F, 4.0F);
  addBox(scene, {3.0F, 1.9F, 0.0F}, {3.2F, 2.1F, 0.2F}); // below the laser, above the wheels' reach
  Driven robot(std::move(scene), {1.2, 2.0, 0.0});
  robot.goAhead(400, 20.0);
  EXPECT_LE(robot.truth().unseenContacts + robot.truth().collisions, 3);
  EXPECT_GT(robot.truth().pose.x, 3.8);
}

TEST(Motion, StandsWhenSomebodyAsksForIt)
{
  Driven robot(makeRoom(6.0F, 4.0F), {1.0, 2.0, 0.0});
  robot.goAhead(10, 20.0);
  robot.stop = true;
  EXPECT_THROW(robot.motion.tick(), StopRequested);
  const Pose2 there = robot.truth().pose;
  EXPECT_THROW(robot.motion.tick(), StopRequested);
  EXPECT_NEAR(robot.truth().pose.x, there.x, 0.005);
}

} // namespace
} // namespace homeward
