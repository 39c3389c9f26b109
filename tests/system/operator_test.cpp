// SPDX-License-Identifier: GPL-3.0-or-later
// The operator's hands while a robot drives: keys over a terminal, buttons of a joystick.
#include "pty_program.h"
#include "rig_fixture.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/joystick.h>
#include <sys/stat.h>

namespace homeward
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Wall = std::chrono::steady_clock;

class OperatorTest : public RigTest
{
protected:
  std::vector<std::string> explore() const
  {
    return {"explore", "--rig", rigFile(), "--map", folder / "room.hwm", "--overwrite"};
  }

  /** Waits until the robot stands. @return seconds that took */
  double untilItStands(PtyProgram &program) const
  {
    const auto begin = Wall::now();
    EXPECT_TRUE(program.eventually([&] { return !moves(); }));
    return std::chrono::duration<double>(Wall::now() - begin).count();
  }

  /** Braking from 0.4 m/s at 0.5 m/s^2 three times as fast as we live, two ticks, and slack for a
   * machine that is busy. */
  static constexpr double kToRest = 0.8 / 3.0 + 0.2 / 3.0 + 0.5;
};

class StopKey : public OperatorTest, public testing::WithParamInterface<std::string>
{};

INSTANTIATE_TEST_SUITE_P(
    Is, StopKey, testing::Values("s", " ", "\x1A", "\x03"), [](const auto &each) {
      const std::string &key = each.param;
      return key == "s" ? "S" : key == " " ? "Space" : key == "\x1A" ? "ControlZ" : "ControlC";
    });

TEST_P(StopKey, StopsTheRobotAndEndsAsAStopDoes)
{
  PtyProgram program(explore());
  ASSERT_TRUE(program.says("s or space stops the robot"));
  ASSERT_TRUE(program.eventually([&] { return moves(); }));
  EXPECT_FALSE(program.isCooked());
  program.type(GetParam());
  const double rest = untilItStands(program);
  std::printf("| key to rest | %.2f s |\n", rest);
  EXPECT_LT(rest, kToRest);
  EXPECT_EQ(program.status(), 1);
  EXPECT_THAT(program.output(),
              AllOf(HasSubstr("stopped"), HasSubstr("go on with: homeward explore --resume")));
  EXPECT_TRUE(program.isCooked());
  EXPECT_FALSE(moves());
}

TEST_F(OperatorTest, AKeyStopsACheckThatMovesToo)
{
  PtyProgram program({"rig", "check", "--move", rigFile()});
  ASSERT_TRUE(program.says("Type yes: "));
  program.type("yes\n");
  ASSERT_TRUE(program.eventually([&] { return moves(); }));
  program.type("s");
  EXPECT_LT(untilItStands(program), kToRest);
  EXPECT_EQ(program.status(), 1);
  EXPECT_THAT(program.output(), HasSubstr("stopped; the robot stands"));
}

struct End
{
  std::string name;
  std::function<void(PtyProgram &)> how;
  int status;
};

class ProgramEnd : public OperatorTest, public testing::WithParamInterface<End>
{};

INSTANTIATE_TEST_SUITE_P(
    By, ProgramEnd,
    testing::Values(End{"Termination", [](PtyProgram &it) { it.signal(SIGTERM); }, 1},
                    End{"HangUp", [](PtyProgram &it) { it.signal(SIGHUP); }, 1},
                    End{"Abort", [](PtyProgram &it) { it.signal(SIGABRT); }, -SIGABRT},
                    End{"Quit", [](PtyProgram &it) { it.type("\x1C"); }, -SIGQUIT},
                    End{"Crash", [](PtyProgram &it) { it.signal(SIGSEGV); }, -SIGSEGV}),
    [](const auto &each) { return each.param.name; });

TEST_P(ProgramEnd, LeavesTheTerminalAsItWas)
{
  PtyProgram program(explore());
  ASSERT_TRUE(program.says("s or space stops the robot"));
  ASSERT_FALSE(program.isCooked());
  GetParam().how(program);
  EXPECT_EQ(program.status(), GetParam().status) << program.output();
  EXPECT_TRUE(program.isCooked());
}

TEST_F(OperatorTest, ATerminalThatIsGoneStopsTheRobot)
{
  PtyProgram program(explore());
  ASSERT_TRUE(program.says("s or space stops the robot"));
  ASSERT_TRUE(program.eventually([&] { return moves(); }));
  program.hangUp();
  EXPECT_LT(untilItStands(program), kToRest);
  EXPECT_NE(program.status(), 999);
  EXPECT_FALSE(moves());
}

TEST_F(OperatorTest, WithoutATerminalThereAreNoKeysAndNoQuestions)
{
  fault("estop", true);
  const ProgramRun run =
      runProgram("explore --rig " + rigFile() + " --map " + folder / "room.hwm", "echo sg | ");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("motors stay off"), Not(HasSubstr("press g"))));
}

/** A joystick whose records a test writes. */
class JoystickTest : public OperatorTest
{
protected:
  JoystickTest()
  {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    m_joystick = ::open(path.c_str(), O_RDWR | O_CLOEXEC); // so that it is there at once
  }
  ~JoystickTest() override { unplug(); }

  void send(std::uint8_t type, std::uint8_t number, std::int16_t value) const
  {
    const js_event event{0, value, type, number};
    EXPECT_EQ(::write(m_joystick, &event, sizeof event), static_cast<ssize_t>(sizeof event));
  }

  void unplug()
  {
    if (m_joystick >= 0) {
      ::close(m_joystick);
      m_joystick = -1;
    }
  }

  std::string path = folder / "js0";

private:
  int m_joystick = -1;
};

TEST_F(JoystickTest, AnyOfItsButtonsStopsTheRobotAndNothingElseOfIt)
{
  more = "stop_joystick: " + path + "\n";
  PtyProgram program(explore());
  ASSERT_TRUE(program.says("s or space stops the robot"));
  send(JS_EVENT_BUTTON | JS_EVENT_INIT, 0, 0);
  send(JS_EVENT_AXIS | JS_EVENT_INIT, 1, -32767);
  send(JS_EVENT_AXIS, 0, 12345);
  send(JS_EVENT_BUTTON, 1, 0); // let go
  ASSERT_TRUE(program.eventually([&] { return moves(); }));
  EXPECT_THAT(program.output(), Not(HasSubstr("stopping")));
  send(JS_EVENT_BUTTON, 3, 1);
  const double rest = untilItStands(program);
  std::printf("| button to rest | %.2f s |\n", rest);
  EXPECT_LT(rest, kToRest);
  EXPECT_EQ(program.status(), 1);
  EXPECT_THAT(program.output(),
              AllOf(HasSubstr("button 3 of the joystick"), HasSubstr("go on with")));
}

TEST_F(JoystickTest, ThatIsUnpluggedStopsTheRobot)
{
  std::vector<std::string> arguments = explore();
  arguments.insert(arguments.end(), {"--joystick", path});
  PtyProgram program(arguments);
  ASSERT_TRUE(program.says("s or space stops the robot"));
  ASSERT_TRUE(program.eventually([&] { return moves(); }));
  unplug();
  EXPECT_LT(untilItStands(program), kToRest);
  EXPECT_EQ(program.status(), 1);
  EXPECT_THAT(program.output(), HasSubstr("the joystick is gone"));
}

TEST_F(JoystickTest, AButtonThatIsHeldAtTheBeginningStopsItToo)
{
  send(JS_EVENT_BUTTON | JS_EVENT_INIT, 5, 1);
  const ProgramRun run = runProgram("explore --rig " + rigFile() + " --map " + folder / "room.hwm" +
                                    " --joystick " + path);
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("button 5 of the joystick"), HasSubstr("stopped")));
}

TEST_F(OperatorTest, AJoystickThatIsNotThereIsRefusedInOneLine)
{
  const ProgramRun run = runProgram("explore --rig " + rigFile() + " --map " + folder / "room.hwm" +
                                    " --joystick /dev/input/js99");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("/dev/input/js99"));
  EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
}

TEST_F(OperatorTest, AfterTheEmergencyStopTheKeyGGoesOn)
{
  PtyProgram program(explore());
  ASSERT_TRUE(program.says("s or space stops the robot"));
  ASSERT_TRUE(program.eventually([&] { return moves(); }));
  fault("estop", true);
  ASSERT_TRUE(program.says("press g to go on"));
  EXPECT_THAT(program.output(), HasSubstr("fault: "));
  EXPECT_LT(untilItStands(program), kToRest);
  program.type("g"); // still pressed
  ASSERT_TRUE(program.says("motors stay off"));
  fault("estop", false);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_FALSE(moves());
  program.type("g");
  EXPECT_TRUE(program.eventually([&] { return moves(); }));
  program.type("s");
  EXPECT_EQ(program.status(), 1);
  EXPECT_THAT(program.output(), HasSubstr("go on with"));
}

TEST_F(OperatorTest, ALinkThatIsLostComesBackAndTheKeyGGoesOnOrSEnds)
{
  PtyProgram program(explore());
  ASSERT_TRUE(program.says("s or space stops the robot"));
  for (const std::string key : {"g", "s"}) {
    ASSERT_TRUE(program.eventually([&] { return moves(); }));
    const std::size_t before = program.output().size();
    const auto saysSince = [&](const std::string &text) {
      return program.eventually(
          [&] { return program.output().find(text, before) != std::string::npos; });
    };
    fault("base", true); // it obeys, but nothing comes back
    ASSERT_TRUE(saysSince("reconnecting, 1 of 8"));
    EXPECT_TRUE(program.eventually([&] { return !moves(); }));
    fault("base", false);
    ASSERT_TRUE(saysSince("press g to go on"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    EXPECT_FALSE(moves());
    program.type(key);
  }
  EXPECT_EQ(program.status(), 1);
  EXPECT_FALSE(moves());
  EXPECT_THAT(program.output(), AllOf(HasSubstr("stopped"), HasSubstr("go on with")));
}

TEST_F(OperatorTest, ARobotThatDoesNotComeBackEndsTheMissionWithItsReason)
{
  std::vector<std::string> arguments = explore();
  arguments.insert(arguments.end(), {"--reconnect", "2"});
  PtyProgram program(arguments);
  ASSERT_TRUE(program.says("s or space stops the robot"));
  ASSERT_TRUE(program.eventually([&] { return moves(); }));
  sim.end(SIGKILL);
  EXPECT_EQ(program.status(), 1);
  EXPECT_THAT(program.output(), AllOf(HasSubstr("reconnecting, 2 of 2"), HasSubstr("homeward: "),
                                      Not(HasSubstr("press g"))));
  EXPECT_TRUE(program.isCooked());
}

} // namespace
} // namespace homeward
