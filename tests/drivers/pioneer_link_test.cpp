// SPDX-License-Identifier: GPL-3.0-or-later
// What a Pioneer's driver does when its link breaks, its speed is unknown or its motors go off.
#include <homeward/core/error.h>
#include <homeward/drivers/reconnect.h>

#include "fake_pioneer.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using enum ArcosCommand;

PioneerOptions quickOptions()
{
  PioneerOptions options;
  options.limits = {0.4, radians(40.0), 0.3, 0.5, radians(100.0)};
  options.commandLife = kPatience;
  options.pulse = std::chrono::milliseconds(50);
  options.answerTimeout = std::chrono::milliseconds(500);
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

class PioneerLink : public testing::TestWithParam<std::string>
{
protected:
  static Line line() { return GetParam() == "Tcp" ? tcpLine() : serialLine(); }
};

INSTANTIATE_TEST_SUITE_P(Lines, PioneerLink, testing::Values("Tcp", "Serial"),
                         [](const auto &each) { return each.param; });

TEST_P(PioneerLink, ALostRobotComesBackWithItsMotorsOffAndItsOdometryWhereItWas)
{
  Line first = line();
  auto robot = std::make_unique<FakePioneer>(first.device);
  PioneerBase base(std::move(first.driver), quickOptions());
  base.drive({0.2, 0.0});
  EXPECT_TRUE(soon([&] { return base.state().odometry.x > 0.05; }));
  robot.reset();
  EXPECT_TRUE(soon([&] { return !complaint([&] { base.state(); }).empty(); }));

  Line second = line();
  FakePioneer again(second.device);
  again.setPosition(12345); // another beginning of its counters
  double before = 0.0;
  base.reconnect([&] { return std::move(second.driver); });
  const BaseState state = base.state();
  EXPECT_THAT(state.halt, HasSubstr("link"));
  EXPECT_GT(state.odometry.x, 0.05);
  EXPECT_LT(state.odometry.x, 2.0);
  before = state.odometry.x;
  // A control loop that has noticed nothing moves it by no hair.
  EXPECT_THAT(complaint([&] { base.drive({0.2, 0.0}); }), HasSubstr("does not drive"));
  EXPECT_NO_THROW(base.drive({}));
  EXPECT_FALSE(again.hasHeard(arcosCommand(Enable, 1)));
  EXPECT_FALSE(again.hasHeard(arcosCommand(Vel, 200)));

  base.enableMotors();
  EXPECT_EQ(base.state().halt, "");
  EXPECT_TRUE(again.heard({arcosCommand(Vel, 0), arcosCommand(Enable, 1)}));
  base.drive({0.2, 0.0});
  EXPECT_TRUE(soon([&] { return base.state().odometry.x > before + 0.01; }));
}

TEST_P(PioneerLink, ASilentRobotIsClosedBeforeItIsCalledAgain)
{
  Line first = line();
  FakePioneer robot(first.device);
  PioneerOptions options = quickOptions();
  options.silence = std::chrono::milliseconds(200);
  PioneerBase base(std::move(first.driver), options);
  base.drive({0.2, 0.0});
  robot.fallSilent();
  EXPECT_TRUE(soon([&] { return !complaint([&] { base.state(); }).empty(); }));
  EXPECT_THAT(complaint([&] {
                base.reconnect(
                    []() -> std::unique_ptr<ByteStream> { throw DeviceError("nobody there"); });
              }),
              HasSubstr("nobody there"));
  EXPECT_TRUE(robot.heard({arcosCommand(Vel, 200), arcosCommand(Vel, 0), arcosCommand(Enable, 0),
                           arcosCommand(Close, 1)}));
  EXPECT_THAT(complaint([&] { base.state(); }), HasSubstr("is lost"));
  EXPECT_THAT(complaint([&] { base.drive({}); }), HasSubstr("is lost"));
  EXPECT_THAT(complaint([&] { base.enableMotors(); }), HasSubstr("is lost"));
}

TEST(PioneerReconnect, AnotherRobotIsRefused)
{
  Line first = tcpLine();
  auto robot = std::make_unique<FakePioneer>(first.device);
  PioneerBase base(std::move(first.driver), quickOptions());
  robot.reset();
  Line second = tcpLine();
  FakePioneer other(second.device, "p3at");
  EXPECT_THAT(complaint([&] { base.reconnect([&] { return std::move(second.driver); }); }),
              HasSubstr("(p3at)"));
  EXPECT_TRUE(other.heard({arcosCommand(Close, 1)}));
  EXPECT_THAT(complaint([&] { base.state(); }), HasSubstr("is lost"));
}

TEST(PioneerReconnect, IsTriedAgainAndAgainButNotForEver)
{
  Line line = tcpLine();
  auto robot = std::make_unique<FakePioneer>(line.device);
  PioneerBase base(std::move(line.driver), quickOptions());
  robot.reset();
  ReconnectOptions options;
  options.tries = 4;
  options.pause = std::chrono::milliseconds(40);
  options.longestPause = std::chrono::milliseconds(80);
  const SteadyClock clock;
  std::vector<Time> calls;
  std::vector<std::string> said;
  std::atomic<bool> stop{false};
  const auto nobody = [&]() -> std::unique_ptr<ByteStream> {
    calls.push_back(clock.now());
    throw DeviceError("nobody there");
  };
  const auto say = [&](const std::string &text) { said.push_back(text); };
  EXPECT_THAT(complaint([&] { reconnect(base, nobody, options, stop, say); }),
              HasSubstr("nobody there"));
  EXPECT_THAT(said, ElementsAre("reconnecting, 1 of 4", HasSubstr("2 of 4: nobody there"),
                                HasSubstr("3 of 4"), HasSubstr("4 of 4")));
  ASSERT_EQ(calls.size(), 4U);
  EXPECT_GE(calls[1] - calls[0], options.pause);
  EXPECT_GE(calls[2] - calls[1], 2 * options.pause);
  EXPECT_GE(calls[3] - calls[2], options.longestPause);

  stop = true;
  EXPECT_FALSE(reconnect(base, nobody, options, stop, say));
  EXPECT_EQ(calls.size(), 4U);
  options.tries = 0;
  EXPECT_THROW(reconnect(base, nobody, options, stop, say), LogicError);

  stop = false;
  options.tries = 1;
  Line second = tcpLine();
  FakePioneer again(second.device);
  EXPECT_TRUE(reconnect(
      base, [&] { return std::move(second.driver); }, options, stop, say));
  EXPECT_NO_THROW(base.state());
}

const std::vector<int> kBauds = {9600, 19200, 38400, 57600, 115200};

TEST(PioneerBauds, TheSpeedAtWhichARobotAnswersIsFound)
{
  const std::vector<speed_t> speeds = {B9600, B19200, B38400, B57600, B115200};
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    for (const bool open : {false, true}) {
      Line line = serialLine();
      FakePioneer robot(line.device, "p3at", open, speeds[i]);
      PioneerOptions options = quickOptions();
      options.bauds = kBauds;
      options.answerTimeout = std::chrono::milliseconds(150);
      const PioneerBase base(std::move(line.driver), options);
      EXPECT_EQ(base.baud(), kBauds[i]);
    }
  }
}

TEST(PioneerBauds, WithoutASearchTheWrongSpeedIsSilence)
{
  Line line = serialLine(9600);
  FakePioneer robot(line.device, "p3at", false, B38400);
  PioneerOptions options = quickOptions();
  options.answerTimeout = std::chrono::milliseconds(20);
  EXPECT_THAT(complaint([&] { PioneerBase(std::move(line.driver), options); }),
              HasSubstr("no Pioneer answers"));
}

TEST(PioneerBauds, WhereNobodyAnswersAllSpeedsAreNamed)
{
  Line line = serialLine();
  FakePioneer robot(line.device, "p3at", false, B1200);
  PioneerOptions options = quickOptions();
  options.bauds = kBauds;
  options.answerTimeout = std::chrono::milliseconds(20);
  EXPECT_THAT(complaint([&] { PioneerBase(std::move(line.driver), options); }),
              HasSubstr("at 9600, 19200, 38400, 57600, 115200 baud"));
}

struct Switch
{
  std::string name;
  std::uint16_t flags;
  std::string reason;
};

class PioneerSwitch : public testing::TestWithParam<Switch>
{};

INSTANTIATE_TEST_SUITE_P(Of, PioneerSwitch,
                         testing::Values(Switch{"EmergencyStop", ArcosSip::kEmergencyStop,
                                                "emergency stop is pressed"},
                                         Switch{"EmergencyStopThatLeavesTheMotorsOn",
                                                ArcosSip::kEmergencyStop | ArcosSip::kMotorsOn,
                                                "emergency stop is pressed"},
                                         Switch{"Motors", 0, "motors were switched off"}),
                         [](const auto &each) { return each.param.name; });

TEST_P(PioneerSwitch, HaltsTheRobotUntilMotionIsAskedForAnew)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerBase base(std::move(line.driver), quickOptions());
  base.drive({0.2, 0.0});
  EXPECT_EQ(base.state().halt, "");
  robot.forget();
  robot.setFlags(GetParam().flags);
  EXPECT_TRUE(soon([&] { return !base.state().halt.empty(); }));
  EXPECT_THAT(base.state().halt, HasSubstr(GetParam().reason));
  EXPECT_TRUE(robot.heard({arcosCommand(Vel, 0), arcosCommand(RVel, 0), arcosCommand(Enable, 0)}));
  EXPECT_THAT(complaint([&] { base.drive({0.2, 0.0}); }), HasSubstr(GetParam().reason));

  // The operator's hand alone, on the motors button say, does not make it go on.
  robot.forget();
  robot.setFlags(ArcosSip::kMotorsOn);
  EXPECT_TRUE(robot.heard({arcosCommand(Pulse), arcosCommand(Pulse)}));
  EXPECT_THAT(complaint([&] { base.drive({0.2, 0.0}); }), HasSubstr(GetParam().reason));
  EXPECT_EQ(base.state().velocity.v, 0.0);

  base.enableMotors();
  EXPECT_EQ(base.state().halt, "");
  base.drive({0.2, 0.0});
  EXPECT_TRUE(soon([&] { return base.state().velocity.v == 0.2; }));
}

TEST(PioneerHalt, MotorsThatStayOffAreSaid)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  robot.setFlags(ArcosSip::kEmergencyStop);
  PioneerOptions options = quickOptions();
  options.answerTimeout = std::chrono::milliseconds(200);
  PioneerBase base(std::move(line.driver), options); // listened to all the same
  EXPECT_THAT(base.state().halt, HasSubstr("motors stay off"));
  EXPECT_THAT(complaint([&] { base.enableMotors(); }), HasSubstr("motors stay off"));
  EXPECT_THAT(base.state().halt, HasSubstr("motors stay off"));
}

TEST(PioneerBumpers, SayWhereTheyArePressed)
{
  Line line = tcpLine();
  FakePioneer robot(line.device);
  PioneerBase base(std::move(line.driver), quickOptions());
  EXPECT_FALSE(base.state().bumpedAhead || base.state().bumpedBehind || base.state().stalled);
  robot.setStall(0x0200);
  EXPECT_TRUE(soon([&] { return base.state().bumpedAhead; }));
  EXPECT_FALSE(base.state().bumpedBehind || base.state().stalled);
  robot.setStall(0x0080);
  EXPECT_TRUE(soon([&] { return base.state().bumpedBehind; }));
  EXPECT_FALSE(base.state().bumpedAhead || base.state().stalled);
  robot.setStall(0x8101);
  EXPECT_TRUE(soon([&] { return base.state().bumpedAhead && base.state().stalled; }));
  EXPECT_FALSE(base.state().bumpedBehind);
}

} // namespace
} // namespace homeward
