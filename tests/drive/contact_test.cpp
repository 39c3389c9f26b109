// SPDX-License-Identifier: GPL-3.0-or-later
// What the control loop does when bumpers are pressed or the base is halted.
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/pilot/motion.h>
#include <homeward/sim/simulator.h>

#include <functional>
#include <gmock/gmock.h>

namespace homeward
{
namespace
{

/** A simulated base that also has bumpers and switches, which a test presses. */
class SwitchedBase final : public MobileBase
{
public:
  explicit SwitchedBase(MobileBase &base) : m_base(base) {}

  void drive(const Twist2 &twist) override
  {
    m_pushes += (m_told.bumpedAhead && twist.v > 0.0) || (m_told.bumpedBehind && twist.v < 0.0);
    m_driven = twist;
    m_base.drive(twist);
  }

  BaseState state() override
  {
    m_told = m_base.state();
    press(m_told);
    return m_told;
  }

  /** How often it was told to drive against a bumper that it had said is pressed. */
  int pushes() const { return m_pushes; }
  Twist2 driven() const { return m_driven; }

  std::function<void(BaseState &)> press = [](BaseState &) {};

private:
  MobileBase &m_base;
  BaseState m_told;
  Twist2 m_driven;
  int m_pushes = 0;
};

/** A bare hall with the robot at its left end, looking along it. */
class Contact : public testing::Test
{
protected:
  void goAhead(int ticks)
  {
    for (int i = 0; i < ticks; ++i) {
      const Eigen::Vector2d goal = motion.pose().inverse() * Eigen::Vector2d(20.0, 0.0);
      motion.tick();
      motion.steer(std::atan2(goal.y(), goal.x()), 0.3, Motion::Room::Ample);
    }
  }

  double x() { return motion.pose().x; }

  static SimulatorOptions startOptions()
  {
    SimulatorOptions options;
    options.start = Pose2{1.0, 2.5, 0.0};
    return options;
  }

  Simulator simulator{share(makeRoom(9.0F, 5.0F)), testRobot(), testCamera(), startOptions()};
  SwitchedBase base{simulator.base()};
  std::atomic<bool> stop = false;
  Motion motion{
      {simulator.clock(), base, simulator.laser(), simulator.camera()}, testRobot(), {}, stop};
};

TEST_F(Contact, ABumperAheadIsBackedOffFromAndDrivenRound)
{
  // A kerb 2 m ahead that neither laser nor sonar sees, 40 cm wide.
  const double front = testRobot().footprint().xMax;
  base.press = [front](BaseState &state) {
    const Eigen::Vector2d nose = state.odometry * Eigen::Vector2d(front, 0.0);
    state.bumpedAhead = nose.x() > 2.0 && nose.x() < 2.3 && std::abs(nose.y()) < 0.2;
  };
  goAhead(80);
  EXPECT_LT(x(), 2.0);
  goAhead(220);
  EXPECT_GT(x(), 3.0);
  EXPECT_EQ(base.pushes(), 0);
}

TEST_F(Contact, CreepsUntilItIsAwayFromWhereItFeltSomething)
{
  goAhead(40);
  const double felt = x();
  ASSERT_GT(base.driven().v, 0.2);
  base.press = [held = 3](BaseState &state) mutable { state.stalled = held-- > 0; };
  double beside = 0.0;
  double away = 0.0;
  for (int i = 0; i < 300; ++i) {
    goAhead(1);
    const bool near = std::hypot(x() - felt, motion.pose().y) < 0.3;
    (near ? beside : away) = std::max(near ? beside : away, base.driven().v);
  }
  EXPECT_GT(beside, 0.01);
  EXPECT_LT(beside, 0.05);
  EXPECT_GT(away, 0.2);
}

TEST_F(Contact, ABumperBehindEndsTheWayBack)
{
  goAhead(80);
  const double before = x();
  ASSERT_GT(before, 1.5);
  const double barred = before - 0.5;
  base.press = [barred](BaseState &state) { state.bumpedBehind = state.odometry.x < barred; };
  motion.retrace(1.0);
  EXPECT_NEAR(x(), barred, 0.1);
  motion.tick(); // frees itself, by no way back
  EXPECT_GT(x(), barred - 0.1);
  EXPECT_EQ(base.pushes(), 0);
}

TEST_F(Contact, ABumperPressedOnARobotThatStandsNeverMovesItThatWay)
{
  motion.tick();
  base.press = [](BaseState &state) { state.bumpedAhead = state.bumpedBehind = true; };
  for (int i = 0; i < 5; ++i) {
    motion.tick();
    motion.steer(0.0, 0.3, Motion::Room::Ample);
  }
  EXPECT_NEAR(x(), 0.0, 0.01);
  EXPECT_EQ(base.pushes(), 0);
}

TEST_F(Contact, ABumperThatStaysPressedIsNotPushedAgainst)
{
  base.press = [](BaseState &state) { state.bumpedAhead = true; };
  for (int i = 0; i < 10; ++i) {
    motion.tick(); // there is no way back either: what it believes of the contact is given up
    motion.steer(0.0, 0.3, Motion::Room::Ample);
  }
  EXPECT_LT(x(), 0.01);
  EXPECT_EQ(base.pushes(), 0);
}

TEST_F(Contact, ABumperThatStaysPressedWhereverItGoesIsStuck)
{
  goAhead(80);
  const double there = x();
  base.press = [](BaseState &state) { state.bumpedAhead = true; };
  EXPECT_THROW(goAhead(200), DeviceError);
  EXPECT_EQ(base.driven().v, 0.0);
  EXPECT_GT(x(), there - 0.3);
  EXPECT_EQ(base.pushes(), 0);
}

TEST_F(Contact, WhoIsSqueezedMovesNeitherWay)
{
  goAhead(6); // slowly yet: it soon goes backwards
  const double there = x();
  double farthest = there;
  base.press = [&farthest](BaseState &state) {
    farthest = std::max(farthest, state.odometry.x);
    state.bumpedAhead = true;
    state.bumpedBehind = state.odometry.x < farthest - 0.002;
  };
  motion.tick(); // backs off, into something behind
  EXPECT_GT(x(), there - 0.1);
  EXPECT_EQ(base.pushes(), 0);
}

TEST_F(Contact, ABaseThatIsHaltedEndsTheMotionWithItsReason)
{
  goAhead(30);
  ASSERT_GT(base.driven().v, 0.1);
  base.press = [](BaseState &state) { state.halt = "its emergency stop is pressed"; };
  try {
    motion.tick();
    FAIL() << "drives on";
  }
  catch (const DeviceError &error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("its emergency stop is pressed"));
  }
  EXPECT_EQ(base.driven().v, 0.0);
  // Who asked for a stop gets one.
  stop = true;
  EXPECT_THROW(motion.tick(), StopRequested);
}

} // namespace
} // namespace homeward
