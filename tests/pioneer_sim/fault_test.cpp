// SPDX-License-Identifier: GPL-3.0-or-later
#include "fault_drive.h"

namespace homeward
{
namespace
{

TEST_F(Fault, SilentBase)
{
  connect();
  silence("base", "has been silent", "base sends no packets");
}

TEST_F(Fault, HalfPackets)
{
  connect();
  silence("half", "has been silent", "base sends half packets");
}

TEST_F(Fault, BadChecksums)
{
  connect();
  silence("checksum", "has been silent", "base sends packets with wrong checksums");
}

TEST_F(Fault, Garbage)
{
  connect();
  silence("garbage", "has been silent", "base sends garbage that begins like packets");
}

TEST_F(Fault, StalledWheels)
{
  connect();
  set("stall");
  watchForRest();
  while (!m_wire.zero() && Seconds(Wall::now() - m_fault).count() < 2.0) {
    m_motion->follow({0.3, 0.0}, 0.0);
    m_motion->tick();
  }
  expectZeroAndRest("wheels are held (the robot then backs out)", kSilence + kZeroWithin);
}

TEST_F(Fault, SilentLaserOnTheBase)
{
  connect();
  silence("laser", "laser", "laser silent, on the base's connection");
}

TEST_F(Fault, SilentLaserOnItsOwnLine)
{
  connect({m_sim.arcosTcp(), m_sim.lmsPty()});
  silence("laser", "laser", "LMS-200 silent");
}

TEST_F(Fault, BlindLaser)
{
  connect();
  silence("blind", "laser", "laser's window covered: it sends readings, none known");
}

TEST_F(Fault, LaserUpsideDown)
{
  connect();
  m_motion->stop();
  set("upside_down"); // shows when the robot turns
  m_wire.forgetZero();
  constexpr double kTwoTurns = 1.2; // s for two turns of 10 degrees
  const std::string said = untilItGivesUp([this] {
    m_motion->turn(0.6);
    m_motion->tick();
  });
  EXPECT_THAT(said, testing::HasSubstr("upside down"));
  watchForRest();
  expectZeroAndRest(
      "laser mounted upside down: the room turns the wrong way, from the first turn on",
      kTwoTurns + kZeroWithin);
}

TEST_F(Fault, SilentCamera)
{
  connect();
  silence("camera", "camera", "camera sends no pictures");
}

TEST_F(Fault, FrozenCamera)
{
  connect();
  silence("frozen", "camera", "camera frozen: the same picture again and again");
}

TEST_F(Fault, CameraCutInTheMiddleOfAPicture)
{
  connect();
  silence("cut", "camera", "camera's stream ends in the middle of a picture");
}

TEST_F(Fault, LateCamera)
{
  connect();
  set("late");
  watchForRest();
  while (!m_wire.zero() && Seconds(Wall::now() - m_fault).count() < 2.0) {
    m_motion->follow({0.3, 0.0}, 0.0);
    m_motion->tick(); // waits until the pictures have caught up
  }
  expectZeroAndRest("camera's pictures queue up on their way for a second", kSilence + kZeroWithin);
}

TEST_F(Fault, ALaserThatComesBackIsWaitedFor)
{
  connect();
  set("laser");
  std::jthread mender([this] {
    m_clock.sleepUntil(m_clock.now() + std::chrono::seconds(1));
    set("laser", false);
  });
  driveFor(3.0);
  EXPECT_EQ(m_wire.last(), 300);
}

TEST_F(Fault, TheControlLoopHangs)
{
  connect();
  m_fault = Wall::now();
  watchForRest();
  ASSERT_TRUE(soon([this] { return m_wire.zero().has_value(); })); // nobody ticks
  expectZeroAndRest("the control loop hangs", kSilence + kZeroWithin);
}

TEST_F(Fault, SomebodyStopsIt)
{
  connect();
  m_stop = true;
  m_fault = Wall::now();
  watchForRest();
  EXPECT_EQ(driveUntilItGivesUp(), "stopped");
  expectZeroAndRest("stop is asked for (Ctrl-C, a lost terminal)", kZeroWithin);
}

TEST_F(Fault, AnExceptionUnwindsTheControlLoop)
{
  connect();
  m_fault = Wall::now();
  watchForRest();
  try {
    const std::unique_ptr<Motion> motion = std::move(m_motion);
    throw std::runtime_error("somewhere above");
  }
  catch (const std::runtime_error &) {
    expectZeroAndRest("an exception above the control loop", kZeroWithin);
  }
}

/** Somebody's hand on the robot: a fault of pioneer-sim's, and what the base says of it. */
class HandOnTheRobot : public Fault
{
protected:
  void expectHaltUntilAskedForAnew(const char *fault, const char *said, const char *name)
  {
    connect();
    set(fault);
    watchForRest();
    EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr(said));
    expectZeroAndRest(name, kZeroWithin);
    EXPECT_THROW(m_base->enableMotors(), DeviceError); // not while it is pressed
    set(fault, false);
    EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr("does not drive"));
    EXPECT_EQ(truth("v_m_s"), 0.0);
    m_base->enableMotors();
    driveFor(1.5);
    EXPECT_GT(truth("v_m_s"), 0.2);
  }
};

TEST_F(HandOnTheRobot, EmergencyStop)
{
  expectHaltUntilAskedForAnew("estop", "emergency stop is pressed", "emergency stop pressed");
}

TEST_F(HandOnTheRobot, MotorsButton)
{
  expectHaltUntilAskedForAnew("motors", "motors were switched off", "motors button pressed");
}

TEST_F(HandOnTheRobot, AFrontBumperIsBackedOffFrom)
{
  connect();
  set("front");
  double farthest = 0.0;
  double back = 0.0;
  for (const auto begin = Wall::now(); Seconds(Wall::now() - begin).count() < 3.0;) {
    m_motion->tick();
    m_motion->follow({0.3, 0.0}, 0.0);
    EXPECT_TRUE(!m_motion->sight().base.bumpedAhead || m_wire.last() <= 0);
    farthest = std::max(farthest, m_motion->pose().x);
    back = std::max(back, farthest - m_motion->pose().x);
  }
  EXPECT_GT(back, 0.05);
  EXPECT_EQ(truth("collisions"), 0.0);
}

} // namespace
} // namespace homeward
