// SPDX-License-Identifier: GPL-3.0-or-later
#include "../drivers/bytes_of.h"
#include "arcos_server.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/arcos_laser.h>

#include <gmock/gmock.h>
#include <limits>

namespace homeward
{
namespace
{

using enum ArcosCommand;
using testing::ElementsAre;
using testing::IsEmpty;

/** A base that goes as it is told, at once. */
class ObedientBase final : public MobileBase
{
public:
  void drive(const Twist2 &twist) override { now.velocity = twist; }
  BaseState state() override { return now; }

  BaseState now;
};

/** A laser that sees i + 1 metres in every whole degree i from the right, and nothing at 10. */
class StairLaser final : public LaserScanner
{
public:
  std::optional<Scan> scan() override
  {
    Scan scan;
    scan.angleMin = -kPi / 2.0;
    scan.angleStep = radians(1.0);
    scan.rangeMax = 15.0;
    for (int i = 0; i <= 180; ++i) {
      scan.ranges.push_back(i == 10 ? kUnknownRange
                                    : std::min(1.0F + static_cast<float>(i), 15.0F));
    }
    return scan;
  }
};

/** A server, what its client hears, and time. */
class ArcosServerTest : public testing::Test
{
protected:
  ArcosServerTest() : server(options()) {}

  static ArcosServerOptions options()
  {
    ArcosServerOptions options;
    options.limits = {0.7, radians(140.0), 0.3, 0.5, radians(100.0)};
    return options;
  }

  void tell(const ArcosPacket &packet) { server.receive(frameArcos(packet), now); }

  /** What the client heard since it was asked last. */
  std::vector<ArcosPacket> heard()
  {
    ArcosReader reader;
    std::vector<ArcosPacket> packets;
    for (const Bytes &bytes : server.takeOutput()) {
      reader.push(bytes, now);
      while (const std::optional<ArcosPacket> packet = reader.next()) {
        packets.push_back(*packet);
      }
    }
    return packets;
  }

  void pass(double seconds)
  {
    for (double passed = 0.0; passed < seconds - 0.01; passed += 0.02) {
      now += std::chrono::milliseconds(20);
      server.step(now, base, laser);
    }
  }

  void open()
  {
    tell(arcosCommand(Sync0));
    tell(arcosCommand(Sync1));
    tell(arcosCommand(Sync2));
    tell(arcosCommand(Open, 1));
    heard();
  }

  ArcosServer server;
  ObedientBase base;
  StairLaser laser;
  Time now{std::chrono::seconds(100)};
};

/** The newest information packet. */
std::optional<ArcosSip> newestSip(const std::vector<ArcosPacket> &packets)
{
  std::optional<ArcosSip> newest;
  for (const ArcosPacket &packet : packets) {
    if (const std::optional<ArcosSip> sip = parseSip(packet)) {
      newest = sip;
    }
  }
  return newest;
}

TEST_F(ArcosServerTest, ItsEmergencyStopStopsItAndTheMotorsStayOffUntilTheyAreEnabled)
{
  open();
  tell(arcosCommand(Enable, 1));
  tell(arcosCommand(Vel, 300));
  pass(1.5);
  EXPECT_NEAR(base.now.velocity.v, 0.3, 1e-9);
  server.press({.emergencyStop = true});
  pass(0.12);
  EXPECT_EQ(base.now.velocity.v, 0.0);
  const ArcosSip pressed = newestSip(heard()).value();
  EXPECT_TRUE(pressed.emergencyStop());
  EXPECT_FALSE(pressed.motorsOn());
  tell(arcosCommand(Enable, 1)); // in vain
  server.press({});
  tell(arcosCommand(Vel, 300));
  pass(1.0);
  EXPECT_EQ(base.now.velocity.v, 0.0);
  const ArcosSip released = newestSip(heard()).value();
  EXPECT_FALSE(released.emergencyStop() || released.motorsOn());
  tell(arcosCommand(Enable, 1));
  tell(arcosCommand(Vel, 300));
  pass(1.0);
  EXPECT_GT(base.now.velocity.v, 0.2);
}

TEST_F(ArcosServerTest, ItsMotorsButtonAndItsBumpersAreInItsPackets)
{
  open();
  tell(arcosCommand(Enable, 1));
  pass(0.2);
  EXPECT_TRUE(newestSip(heard()).value().motorsOn());
  server.press({.motorsOff = true, .frontBumper = true});
  pass(0.2);
  const ArcosSip ahead = newestSip(heard()).value();
  EXPECT_FALSE(ahead.motorsOn() || ahead.emergencyStop());
  EXPECT_TRUE(ahead.bumpedAhead());
  EXPECT_FALSE(ahead.bumpedBehind() || ahead.wheelStalled());
  server.press({.rearBumper = true});
  pass(0.2);
  const ArcosSip behind = newestSip(heard()).value();
  EXPECT_TRUE(behind.bumpedBehind());
  EXPECT_FALSE(behind.bumpedAhead() || behind.wheelStalled());
}

TEST_F(ArcosServerTest, EchoesTwiceThenSaysWhoItIs)
{
  tell(arcosCommand(Sync0));
  EXPECT_THAT(heard(), ElementsAre(arcosCommand(Sync0)));
  tell(arcosCommand(Sync1));
  EXPECT_THAT(heard(), ElementsAre(arcosCommand(Sync1)));
  tell(arcosCommand(Sync2));
  EXPECT_EQ(parseIdentity(heard().at(0))->subclass, "p3at");
  EXPECT_FALSE(server.isOpen());
}

TEST_F(ArcosServerTest, OpenWithoutArgumentIsToldFromSync1ByWhatCameBefore)
{
  tell(arcosCommand(Sync0));
  tell(arcosCommand(Sync1));
  EXPECT_FALSE(server.isOpen());
  tell(arcosCommand(Sync2));
  tell(arcosCommand(Open));
  EXPECT_TRUE(server.isOpen());
  tell(arcosCommand(Close, 1));
  tell(arcosCommand(Open));
  EXPECT_FALSE(server.isOpen());
}

TEST_F(ArcosServerTest, SaysHowItIsEveryTenthOfASecond)
{
  open();
  pass(1.0);
  EXPECT_EQ(heard().size(), 10U);
  tell(arcosCommand(Close, 1));
  pass(1.0);
  EXPECT_THAT(heard(), IsEmpty());
}

TEST_F(ArcosServerTest, SaysWhereItIsInTheUnitsOfItsSubclass)
{
  open();
  base.now.odometry = {0.93, -0.465, radians(90.0)};
  base.now.velocity = {0.2, radians(30.0)};
  base.now.stalled = true;
  base.now.sonar = {{0.0, 0.0, 0.0, 1.5},
                    {0.0, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}};
  pass(0.1);
  const auto sip = parseSip(heard().at(0));
  ASSERT_TRUE(sip);
  EXPECT_TRUE(sip->moving);
  EXPECT_EQ(sip->x, 2000U);
  EXPECT_EQ(sip->y, 65536U - 1000U);
  EXPECT_EQ(sip->heading, 1024);
  EXPECT_EQ(sip->turnRate, 300);
  EXPECT_NEAR(sip->rightSpeed - sip->leftSpeed, 2.0 * 154.0, 2.0);
  EXPECT_EQ(sip->stall, 0x0101);
  EXPECT_EQ(sip->sonars, (std::vector<ArcosSonar>{{0, 1500}, {1, 5000}}));
  EXPECT_NEAR(arcosVelocity(*sip, *ArcosUnits::of("p3at")).v, 0.2, 1e-3);
}

TEST_F(ArcosServerTest, StandsUntilItsMotorsAreEnabled)
{
  open();
  tell(arcosCommand(Vel, 300));
  pass(1.0);
  EXPECT_EQ(base.now.velocity.v, 0.0);
  tell(arcosCommand(Enable, 1));
  pass(1.0);
  EXPECT_EQ(base.now.velocity.v, 0.0); // what was said before does not count
  tell(arcosCommand(Vel, 300));
  pass(2.0);
  EXPECT_DOUBLE_EQ(base.now.velocity.v, 0.3);
}

TEST_F(ArcosServerTest, RampsAsTheClientAsksAndNoFasterThanItCan)
{
  open();
  tell(arcosCommand(Enable, 1));
  tell(arcosCommand(SetA, 100));
  tell(arcosCommand(SetA, -9000));
  tell(arcosCommand(Vel, 300));
  pass(1.0);
  EXPECT_NEAR(base.now.velocity.v, 0.1, 0.003);
  tell(arcosCommand(Pulse));
  pass(1.9);
  tell(arcosCommand(Pulse));
  pass(0.3);
  EXPECT_DOUBLE_EQ(base.now.velocity.v, 0.3);
  tell(arcosCommand(Vel, 0));
  pass(0.3);
  EXPECT_NEAR(base.now.velocity.v, 0.15, 0.003);
}

TEST_F(ArcosServerTest, TurnsAndDrivesByWheels)
{
  open();
  tell(arcosCommand(Enable, 1));
  tell(arcosCommand(RVel, -20));
  pass(1.0);
  EXPECT_NEAR(base.now.velocity.w, radians(-20.0), 1e-9);
  tell({static_cast<std::uint8_t>(Vel2), bytesOf("3B0C07")}); // right 240, left 140 mm/s
  pass(1.5);
  EXPECT_NEAR(base.now.velocity.v, 0.19, 1e-9);
  EXPECT_NEAR(base.now.velocity.w, 0.05 * 3.4, 1e-9);
}

TEST_F(ArcosServerTest, WatchdogStopsItUntilANewVelocityComes)
{
  open();
  tell(arcosCommand(Enable, 1));
  tell(arcosCommand(Vel, 300));
  pass(1.9);
  EXPECT_DOUBLE_EQ(base.now.velocity.v, 0.3);
  pass(0.9);
  EXPECT_EQ(base.now.velocity.v, 0.0);
  tell(arcosCommand(Pulse));
  pass(1.0);
  EXPECT_EQ(base.now.velocity.v, 0.0);
  tell(arcosCommand(Vel, 300));
  pass(1.5);
  EXPECT_DOUBLE_EQ(base.now.velocity.v, 0.3);
}

TEST_F(ArcosServerTest, StopsAndTurnsItsMotorsOffWhenTheClientHasGone)
{
  open();
  tell(arcosCommand(Enable, 1));
  tell(arcosCommand(Vel, 300));
  pass(1.5);
  server.hangUp();
  pass(1.0);
  EXPECT_EQ(base.now.velocity.v, 0.0);
  open();
  tell(arcosCommand(Vel, 300));
  pass(1.0);
  EXPECT_EQ(base.now.velocity.v, 0.0);
}

TEST_F(ArcosServerTest, OdometryGoesToZeroOnRequest)
{
  open();
  base.now.odometry = {1.0, 2.0, radians(90.0)};
  tell(arcosCommand(SetO));
  pass(0.1);
  base.now.odometry = {1.0, 2.93, radians(90.0)}; // ahead
  heard();
  pass(0.1);
  const auto sip = parseSip(heard().at(0));
  EXPECT_EQ(sip->x, 2000U);
  EXPECT_EQ(sip->y, 0U);
  EXPECT_EQ(sip->heading, 0);
}

TEST_F(ArcosServerTest, TellsItsSettings)
{
  open();
  tell(arcosCommand(Config, 1));
  const auto config = parseConfig(heard().at(0));
  ASSERT_TRUE(config);
  EXPECT_EQ(config->subclass, "p3at");
  EXPECT_EQ(config->sipCycle, 100);
  EXPECT_EQ(config->watchdog, 2000);
  EXPECT_EQ(config->speedMax, 700);
  EXPECT_EQ(config->turnRateMax, 140);
}

TEST_F(ArcosServerTest, SendsItsLaserAsAskedFor)
{
  for (const auto &[enable, kind] : {std::pair{1, kLaserPlain}, {2, kLaserExtended}}) {
    open();
    tell(arcosCommand(OldLaserStart, -90));
    tell(arcosCommand(OldLaserEnd, 90));
    tell(arcosCommand(OldLaserIncrement, 100));
    tell(arcosCommand(OldLaserEnable, enable));
    heard();
    pass(0.1);
    ArcosSweepReader sweeps;
    std::optional<std::vector<std::uint16_t>> sweep;
    std::size_t packets = 0;
    for (const ArcosPacket &packet : heard()) {
      if (const auto part = parseLaserPart(packet)) {
        EXPECT_EQ(part->kind, kind);
        ++packets;
        sweep = sweeps.add(*part);
      }
    }
    EXPECT_EQ(packets, 6U);
    ASSERT_TRUE(sweep);
    ASSERT_EQ(sweep->size(), 181U);
    EXPECT_EQ(sweep->at(0), 1000U);
    EXPECT_EQ(sweep->at(5), 6000U);
    EXPECT_EQ(sweep->at(10), 0U);      // nothing measured
    EXPECT_EQ(sweep->at(180), 32000U); // beyond its range
    tell(arcosCommand(Close, 1));
  }
}

TEST_F(ArcosServerTest, PutsTheRobotWhereTheClientWants)
{
  open();
  tell({static_cast<std::uint8_t>(SimSetPose), bytesOf("3B E8030000 18FCFFFF 5A000000")});
  const auto pose = server.takeKidnap();
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x, 1.0);
  EXPECT_DOUBLE_EQ(pose->y, -1.0);
  EXPECT_NEAR(pose->heading, radians(90.0), 1e-12);
  EXPECT_FALSE(server.takeKidnap());
  tell({static_cast<std::uint8_t>(SimSetPose), bytesOf("3B E803")});
  EXPECT_FALSE(server.takeKidnap());
}

TEST_F(ArcosServerTest, CommandsCutShortAndUnknownOnesArePassedOver)
{
  open();
  tell(arcosCommand(Enable, 1));
  tell({static_cast<std::uint8_t>(Vel), bytesOf("3B")});
  tell({static_cast<std::uint8_t>(Vel2), bytesOf("3B 0C")});
  tell({static_cast<std::uint8_t>(SetO), bytesOf("3B")}); // as Player sends it
  tell({62, bytesOf("3B0100")});
  tell({250, {}});
  pass(0.5);
  EXPECT_EQ(base.now.velocity.v, 0.0);
  EXPECT_EQ(heard().size(), 5U);
}

TEST(ArcosServer, ASubclassNobodyKnowsIsRefused)
{
  ArcosServerOptions options;
  options.subclass = "p9";
  EXPECT_THROW(ArcosServer{options}, ConfigError);
}

} // namespace
} // namespace homeward
