// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/pioneer_base.h>

#include "fake_pioneer.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace homeward
{
namespace
{

using testing::HasSubstr;
using enum ArcosCommand;

PioneerOptions quickOptions()
{
  PioneerOptions options;
  options.limits = {0.4, radians(40.0), 0.3, 0.5, radians(100.0)};
  options.commandLife = std::chrono::milliseconds(100);
  options.pulse = std::chrono::milliseconds(50);
  options.answerTimeout = std::chrono::milliseconds(500);
  return options;
}

PioneerOptions steadyOptions()
{
  PioneerOptions options = quickOptions();
  options.commandLife = kPatience;
  return options;
}

/** What DeviceError says; empty when none is thrown. */
std::string complaint(const std::function<void()> &action)
{
  try {
    action();
  }
  catch (const DeviceError &error) {
    return error.what();
  }
  return {};
}

class PioneerOverAnyLine : public testing::TestWithParam<std::string>
{};

TEST_P(PioneerOverAnyLine, ShakesHandsConfiguresDrivesAndSaysGoodbye)
{
  Line line = GetParam() == "Tcp" ? tcpLine() : serialLine();
  FakePioneer robot(line.device);
  {
    PioneerBase base(std::move(line.driver), steadyOptions());
    EXPECT_EQ(base.identity().subclass, "p3at-sh");
    EXPECT_TRUE(
        robot.heard({arcosCommand(Sync0), arcosCommand(Sync1), arcosCommand(Sync2),
                     arcosCommand(Open, 1), arcosCommand(SetV, 400), arcosCommand(SetA, 300),
                     arcosCommand(SetA, -500), arcosCommand(SetRv, 40), arcosCommand(SetRa, 100),
                     arcosCommand(SetRa, -100), arcosCommand(Sonar, 0), arcosCommand(Enable, 1)}));
    const double begin = base.state().odometry.x;
    base.drive({0.2, 0.0});
    EXPECT_TRUE(soon([&] { return base.state().velocity.v == 0.2; }));
    EXPECT_TRUE(soon([&] { return base.state().odometry.x > begin + 0.01; }));
    robot.forget();
  }
  EXPECT_TRUE(robot.heard({arcosCommand(Vel, 0), arcosCommand(RVel, 0), arcosCommand(Enable, 0),
                           arcosCommand(Close, 1)}));
}

INSTANTIATE_TEST_SUITE_P(Lines, PioneerOverAnyLine, testing::Values("Tcp", "Serial"),
                         [](const auto &each) { return each.param; });

TEST(PioneerBase, VelocityIsWholeUnitsWithinTheLimits)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerBase base(std::move(line.driver), steadyOptions());
  base.drive({0.2004, radians(10.4)});
  EXPECT_TRUE(robot.heard({arcosCommand(Vel, 200), arcosCommand(RVel, 10)}));
  base.drive({9.0, -9.0});
  EXPECT_TRUE(robot.heard({arcosCommand(Vel, 400), arcosCommand(RVel, -40)}));
  EXPECT_THROW(base.drive({std::nan(""), 0.0}), LogicError);
  EXPECT_THROW(base.drive({0.0, std::numeric_limits<double>::infinity()}), LogicError);
}

TEST(PioneerBase, StopsWhenNobodyDrivesAnyMore)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerBase base(std::move(line.driver), quickOptions());
  base.drive({0.3, 0.1});
  EXPECT_TRUE(robot.heard({arcosCommand(Vel, 300), arcosCommand(RVel, 6), arcosCommand(Vel, 0),
                           arcosCommand(RVel, 0)}));
  EXPECT_TRUE(soon([&] { return base.state().velocity.v == 0.0; }));
}

TEST(PioneerBase, StopsHardInAnEmergencyAndSaysHowFullItsBatteryIs)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerBase base(std::move(line.driver), steadyOptions());
  robot.setBattery(124);
  EXPECT_TRUE(soon([&] { return std::abs(base.battery().value_or(0.0) - 12.4) < 1e-9; }));
  base.drive({0.2, 0.0});
  EXPECT_TRUE(soon([&] { return base.state().velocity.v == 0.2; }));
  robot.forget();
  base.emergencyStop();
  EXPECT_TRUE(soon([&] { return base.state().velocity.v == 0.0; }));
  EXPECT_TRUE(robot.heard({arcosCommand(EStop)}));
  base.drive({0.2, 0.0}); // whoever releases it says when
  EXPECT_TRUE(soon([&] { return base.state().velocity.v == 0.2; }));
}

TEST(PioneerBase, KeepsAnIdleRobotAwake)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  const PioneerBase base(std::move(line.driver), quickOptions());
  EXPECT_TRUE(robot.heard({arcosCommand(Enable, 1), arcosCommand(Pulse), arcosCommand(Pulse)}));
}

TEST(PioneerBase, ARobotLeftOpenIsClosedFirst)
{
  Line line = tcpLine();
  FakePioneer robot(line.device, "p3at", true);
  PioneerBase base(std::move(line.driver), quickOptions());
  EXPECT_TRUE(robot.heard({arcosCommand(Close, 1), arcosCommand(Sync0), arcosCommand(Open, 1)}));
  EXPECT_EQ(base.state().velocity.v, 0.0);
}

TEST(PioneerBase, SonarEchoesStandAtTheirTransducers)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  robot.setSonars({{1, 1500}, {0, 5000}, {7, 900}});
  PioneerOptions options = quickOptions();
  options.sonars = {{0.1, 0.2, 0.3, 0.5}, {0.4, -0.2, 0.3, -0.5}};
  PioneerBase base(std::move(line.driver), options);
  EXPECT_TRUE(robot.heard({arcosCommand(Sonar, 1)}));
  const BaseState state = base.state();
  ASSERT_EQ(state.sonar.size(), 2U);
  EXPECT_TRUE(std::isnan(state.sonar[0].range));
  EXPECT_DOUBLE_EQ(state.sonar[1].range, 1.5);
  EXPECT_DOUBLE_EQ(state.sonar[1].x, 0.4);
  EXPECT_DOUBLE_EQ(state.sonar[1].bearing, -0.5);
}

TEST(PioneerBase, SaysWhenItsWheelsAreHeld)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerBase base(std::move(line.driver), quickOptions());
  EXPECT_FALSE(base.state().stalled);
  robot.setStall(ArcosSip::kWheels);
  EXPECT_TRUE(soon([&] { return base.state().stalled; }));
}

TEST(PioneerBase, ARobotThatHangsUpIsLost)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerBase base(std::move(line.driver), quickOptions());
  robot.hangUp();
  std::string text;
  EXPECT_TRUE(soon([&] { return !(text = complaint([&] { base.state(); })).empty(); }));
  EXPECT_THAT(text, HasSubstr("'fake' is lost"));
  EXPECT_THAT(complaint([&] { base.drive({0.1, 0.0}); }), HasSubstr("is lost"));
}

TEST(PioneerBase, ASilentRobotIsLostAndToldToStop)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerOptions options = quickOptions();
  options.silence = std::chrono::milliseconds(200);
  PioneerBase base(std::move(line.driver), options);
  base.drive({0.2, 0.0});
  robot.fallSilent();
  EXPECT_TRUE(robot.heard({arcosCommand(Vel, 200), arcosCommand(Vel, 0)}));
  EXPECT_TRUE(soon([&] {
    return complaint([&] { base.drive({0.2, 0.0}); }).find("silent") != std::string::npos;
  }));
}

TEST(PioneerBase, NobodyAnswers)
{
  Line line = tcpLine();
  PioneerOptions options = quickOptions();
  options.answerTimeout = std::chrono::milliseconds(10);
  EXPECT_THAT(complaint([&] { PioneerBase(std::move(line.driver), options); }),
              HasSubstr("no Pioneer answers"));
  ::close(line.device);
}

TEST(PioneerBase, AnUnknownSubclassNeedsUnits)
{
  Line line = tcpLine();
  FakePioneer robot(line.device, "seekur");
  EXPECT_THAT(complaint([&] { PioneerBase(std::move(line.driver), quickOptions()); }),
              HasSubstr("'seekur'"));
  EXPECT_TRUE(robot.heard({arcosCommand(Close, 1)}));

  Line other = tcpLine();
  FakePioneer otherRobot(other.device, "seekur");
  PioneerOptions options = quickOptions();
  options.units = ArcosUnits{};
  EXPECT_NO_THROW(PioneerBase(std::move(other.driver), options));
}

} // namespace
} // namespace homeward
