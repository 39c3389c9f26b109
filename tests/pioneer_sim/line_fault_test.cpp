// SPDX-License-Identifier: GPL-3.0-or-later
#include "cable.h"
#include "fault_drive.h"

namespace homeward
{
namespace
{

/** Lines and processes that go. Where no command reaches the robot, its own watchdog stops it. */
class LineFault : public Fault
{
protected:
  /** Drives until the motion gives up on a robot that nothing reaches. */
  void expectOwnWatchdog(const char *fault)
  {
    watchForRest();
    EXPECT_FALSE(driveUntilItGivesUp().empty());
    name(fault);
    ASSERT_TRUE(m_wire.zero());
    expectWithin("zero", *m_wire.zero(), kSilence + kZeroWithin); // sent, if in vain
    expectRest(kOwnWatchdog + kBraking);
  }
};

TEST_F(LineFault, WrongBaud)
{
  connect();
  set("baud");
  expectOwnWatchdog("base's line runs at the wrong speed: garbled both ways");
}

TEST_F(LineFault, BasesPlugPulledAtTheRobot)
{
  Cable cable(m_sim.arcosPty());
  connect({cable.path(), m_sim.lmsPty()});
  cable.pullAtTheDevice();
  m_fault = Wall::now();
  expectOwnWatchdog("base's plug pulled at the robot");
}

TEST_F(LineFault, BasesPlugPulledAtTheComputer)
{
  Cable cable(m_sim.arcosPty());
  connect({cable.path(), m_sim.lmsPty()});
  cable.pullTheAdapter();
  m_fault = Wall::now();
  watchForRest();
  EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr("is lost"));
  name("base's plug pulled at the computer");
  expectWithin("noticed", Wall::now(), kZeroWithin);
  expectRest(kOwnWatchdog + kBraking);
}

TEST_F(LineFault, LasersPlugPulledAtTheComputer)
{
  Cable cable(m_sim.lmsPty());
  connect({m_sim.arcosTcp(), cable.path()});
  cable.pullTheAdapter();
  m_fault = Wall::now();
  watchForRest();
  EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr("laser is lost"));
  expectZeroAndRest("laser's plug pulled at the computer", kZeroWithin);
}

TEST_F(LineFault, LasersPlugPulledAtTheLaser)
{
  Cable cable(m_sim.lmsPty());
  connect({m_sim.arcosTcp(), cable.path()});
  cable.pullAtTheDevice();
  m_fault = Wall::now();
  watchForRest();
  EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr("laser"));
  expectZeroAndRest("laser's plug pulled at the laser", kSilence + kZeroWithin);
}

TEST_F(LineFault, FullQueue)
{
  connect();
  set("deaf");
  watchForRest();
  const auto begin = Wall::now();
  while (!m_rest.get() && Seconds(Wall::now() - begin).count() < 5.0) {
    m_motion->follow({0.3, 0.0}, 0.0);
    m_motion->tick();
  }
  name("base takes no bytes: commands queue up");
  expectRest(kOwnWatchdog + kBraking);
}

TEST_F(LineFault, TheWholeRobotHangs)
{
  connect();
  m_sim.signal(SIGSTOP);
  m_fault = Wall::now();
  EXPECT_FALSE(driveUntilItGivesUp().empty());
  name("the whole robot hangs (SIGSTOP)");
  ASSERT_TRUE(m_wire.zero());
  expectWithin("zero", *m_wire.zero(), kSilence + kZeroWithin);
  m_sim.signal(SIGCONT);
  EXPECT_TRUE(soon([this] { return truth("v_m_s") == 0.0; }));
}

TEST_F(LineFault, TheRobotIsKilled)
{
  connect();
  m_sim.end(SIGKILL);
  m_fault = Wall::now();
  EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr("is lost"));
  name("the robot's side is killed (SIGKILL)");
  expectWithin("noticed", Wall::now(), kZeroWithin);
}

/** Drives in a process of its own, to which something happens. */
class ClientFault : public Fault
{
protected:
  /** @param number of the signal that it gets @param bound seconds to rest */
  void expectRestAfter(int number, const std::string &address, const char *fault, double bound)
  {
    const pid_t client = ::fork();
    if (client == 0) {
      drive(address);
    }
    EXPECT_TRUE(soon([this] { return truth("v_m_s") > 0.25; }));
    ::kill(client, number);
    m_fault = Wall::now();
    watchForRest();
    name(fault);
    expectRest(bound);
    ::kill(client, SIGKILL);
    ::waitpid(client, nullptr, 0);
  }

private:
  [[noreturn]] static void drive(const std::string &address)
  {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    PioneerBase base(openStream(address, 9600), pioneerOptions());
    SteadyClock clock;
    while (true) {
      base.drive({0.3, 0.0});
      clock.sleepUntil(clock.now() + std::chrono::milliseconds(100));
    }
  }
};

TEST_F(ClientFault, KilledOverTcp)
{
  expectRestAfter(SIGKILL, m_sim.arcosTcp(), "the client is killed (SIGKILL), over TCP", kBraking);
}

TEST_F(ClientFault, KilledOverASerialLine)
{
  expectRestAfter(SIGKILL, m_sim.arcosPty(), "the client is killed (SIGKILL), over a serial line",
                  kOwnWatchdog + kBraking);
}

TEST_F(ClientFault, Suspended)
{
  expectRestAfter(SIGSTOP, m_sim.arcosTcp(), "the client is suspended (SIGSTOP)",
                  kOwnWatchdog + kBraking);
}

} // namespace
} // namespace homeward
