// SPDX-License-Identifier: GPL-3.0-or-later
#include "../drivers/fake_device.h"
#include "sim_process.h"
#include "test_paths.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/pioneer_base.h>
#include <homeward/drivers/protocol/arcos_config.h>
#include <homeward/drivers/sick_laser.h>

#include <gmock/gmock.h>
#include <httplib.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;

/** How much faster than we the robot of these tests lives. */
constexpr double kSpeed = 4.0;

std::vector<std::string> arguments()
{
  const auto room =
      std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/contract/contract_room.sdf";
  return {"--world", room.string(), "--start", "4,5,0", "--threads", "1", "--speed", "4"};
}

PioneerOptions options()
{
  PioneerOptions options;
  options.limits = {0.4, radians(60.0), 0.3, 0.5, radians(100.0)};
  options.clockRate = kSpeed;
  return options;
}

/** One pioneer-sim in a process of its own for all tests: it must outlive whatever they do. */
class PioneerSimProcess : public testing::Test
{
protected:
  PioneerSimProcess() : m_clock(kSpeed) {}

  static void SetUpTestSuite() { sSim = new SimProcess(arguments()); }
  static void TearDownTestSuite()
  {
    delete sSim;
    sSim = nullptr;
  }

  nlohmann::json truth() const
  {
    httplib::Client client("127.0.0.1", sSim->httpPort());
    const auto answer = client.Get("/truth");
    EXPECT_TRUE(answer);
    return answer ? nlohmann::json::parse(answer->body) : nlohmann::json{};
  }

  double speed() const { return truth()["v_m_s"]; }

  /** Lets robot time pass. */
  void wait(double seconds) { m_clock.sleepUntil(m_clock.now() + fromSeconds(seconds)); }

  std::unique_ptr<PioneerBase> connect() const
  {
    return std::make_unique<PioneerBase>(openStream(sSim->arcosTcp(), 9600), options());
  }

  void expectItStillServes()
  {
    const auto base = connect();
    base->drive({0.2, 0.0});
    EXPECT_TRUE(soon([&] { return base->state().velocity.v > 0.05; }));
    base->drive({});
    EXPECT_TRUE(soon([&] { return base->state().velocity.v == 0.0; }));
  }

  SteadyClock m_clock;
  static SimProcess *sSim;
};

SimProcess *PioneerSimProcess::sSim = nullptr;

TEST_F(PioneerSimProcess, ServesClientsOneAfterAnother)
{
  for (int i = 0; i < 5; ++i) {
    const auto base = connect();
    EXPECT_EQ(base->identity().name, "pioneer-sim");
    base->drive({i % 2 == 0 ? 0.2 : -0.2, 0.0});
    EXPECT_TRUE(soon([&] { return std::abs(base->state().velocity.v) > 0.1; }));
  }
  EXPECT_TRUE(soon([&] { return speed() == 0.0; })); // the last one has left
}

TEST_F(PioneerSimProcess, ServesASecondClientWhenTheFirstHasLeft)
{
  auto first = openStream(sSim->arcosTcp(), 9600);
  const auto second = openStream(sSim->arcosTcp(), 9600);
  second->write(frameArcos(arcosCommand(ArcosCommand::Sync0)));
  std::array<std::uint8_t, 64> buffer{};
  EXPECT_EQ(second->read(buffer, std::chrono::milliseconds(100)), 0U);
  first.reset();
  EXPECT_TRUE(soon([&] { return second->read(buffer, std::chrono::milliseconds(100)) > 0; }));
}

TEST_F(PioneerSimProcess, SipsComeEveryTenthOfASecond)
{
  const auto base = connect();
  const Time begin = base->state().stamp;
  int count = 0;
  Time last = begin;
  while (toSeconds(last - begin) < 5.0) {
    const Time stamp = base->state().stamp;
    count += stamp != last ? 1 : 0;
    last = stamp;
    wait(0.005);
  }
  EXPECT_NEAR(count / toSeconds(last - begin), 10.0, 0.7);
}

TEST_F(PioneerSimProcess, TurnsAndDrivesSlowerThanTheWireCanSay)
{
  const auto base = connect();
  const Pose2 begin = base->state().odometry;
  const Time start = m_clock.now();
  Time last = start;
  for (int i = 0; i < 200; ++i) {
    base->drive({0.0, radians(-0.4)});
    last = m_clock.now();
    wait(0.1);
  }
  base->drive({});
  EXPECT_TRUE(soon([&] { return base->state().velocity.w == 0.0; }));
  const double turned = degrees((begin.inverse() * base->state().odometry).heading);
  std::printf("-0.4 deg/s wanted, %.3f measured\n", turned / toSeconds(last - start));
  EXPECT_NEAR(turned / toSeconds(last - start), -0.4, 0.06);
}

TEST_F(PioneerSimProcess, AServoConvergesBelowTheUnitsOfTheWire)
{
  constexpr double kGain = 0.3;          // 1/s: whole deg/s alone would leave 1.7 degrees
  constexpr double kTurn = radians(4.0); // half of what the test before turned the other way
  const auto base = connect();
  const Pose2 begin = base->state().odometry;
  const auto error = [&] { return kTurn - (begin.inverse() * base->state().odometry).heading; };
  for (int i = 0; i < 200; ++i) {
    base->drive({0.0, kGain * error()});
    wait(0.1);
  }
  std::printf("left of 4 degrees: %.3f\n", degrees(error()));
  EXPECT_LT(std::abs(error()), radians(0.3));
}

TEST_F(PioneerSimProcess, GoesOnAfterBadFramesNoiseAndHalfPackets)
{
  {
    const auto stream = openStream(sSim->arcosTcp(), 9600);
    Bytes noise;
    for (int i = 0; i < 20000; ++i) {
      noise.push_back(static_cast<std::uint8_t>(i * 37 % 251 + (i % 3 == 0 ? 1 : 0)));
    }
    stream->write(noise);
    Bytes bad = frameArcos(arcosCommand(ArcosCommand::Vel, 300));
    bad.back() ^= 1U;
    stream->write(bad);
    stream->write(std::span(bad).first(4));
  }
  expectItStillServes();
}

TEST_F(PioneerSimProcess, AClientThatReadsNothingHoldsNobodyUp)
{
  const auto deaf = openStream(sSim->arcosTcp(), 9600);
  for (const ArcosCommand command :
       {ArcosCommand::Sync0, ArcosCommand::Sync1, ArcosCommand::Sync2, ArcosCommand::Open}) {
    deaf->write(frameArcos(arcosCommand(command)));
    wait(0.3);
  }
  for (int i = 0; i < 20000; ++i) { // each is answered with a hundred bytes
    deaf->write(frameArcos(arcosCommand(ArcosCommand::Config, 1)));
  }
  const double before = truth()["sim_time_s"];
  wait(2.0);
  EXPECT_GT(truth()["sim_time_s"].get<double>(), before + 1.0);
}

TEST_F(PioneerSimProcess, AClientThatVanishesLeavesARobotThatStands)
{
  {
    auto stream = openStream(sSim->arcosTcp(), 9600);
    const auto base = std::make_unique<PioneerBase>(openStream(sSim->arcosPty(), 9600), options());
    stream.reset();
    base->drive({0.3, 0.0});
    EXPECT_TRUE(soon([&] { return speed() > 0.1; }));
  }
  EXPECT_TRUE(soon([&] { return speed() == 0.0; }));
}

TEST_F(PioneerSimProcess, ItsOwnWatchdogStopsARobotWhoseClientFellSilent)
{
  const auto stream = openStream(sSim->arcosPty(), 9600);
  const auto say = [&](const ArcosPacket &packet) {
    stream->write(frameArcos(packet));
    wait(0.2);
  };
  say(arcosCommand(ArcosCommand::Close, 1));
  say(arcosCommand(ArcosCommand::Sync0));
  say(arcosCommand(ArcosCommand::Sync1));
  say(arcosCommand(ArcosCommand::Sync2));
  say(arcosCommand(ArcosCommand::Open, 1));
  say(arcosCommand(ArcosCommand::Enable, 1));
  say(arcosCommand(ArcosCommand::Vel, -300));
  wait(1.2);
  EXPECT_LT(speed(), -0.2);
  wait(2.8); // 2 s of watchdog, 0.6 s of braking, less what has passed
  EXPECT_EQ(speed(), 0.0);
}

TEST_F(PioneerSimProcess, ItsLaserMeasuresTheRoomOverASerialLine)
{
  SickOptions sick;
  sick.clockRate = kSpeed;
  SickLaser laser(openStream(sSim->lmsPty(), 9600), sick);
  std::optional<Scan> scan;
  ASSERT_TRUE(soon([&] { return (scan = laser.scan()).has_value(); }));
  ASSERT_EQ(scan->ranges.size(), 181U);
  EXPECT_NEAR(scan->ranges[0], 5.0, 0.1);
  EXPECT_NEAR(scan->ranges[180], 5.0, 0.1);
}

TEST_F(PioneerSimProcess, ServesItsCameraAndItsFaults)
{
  httplib::Client client("127.0.0.1", sSim->httpPort());
  const auto picture = client.Get("/camera.jpg");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->body.substr(0, 2), "\xFF\xD8");
  EXPECT_EQ(client.Post("/fault/base?on=1")->status, 200);
  EXPECT_EQ(client.Post("/fault/base?on=0")->status, 200);
  for (const char *fault : {"estop", "motors", "front", "rear"}) {
    EXPECT_EQ(client.Post(std::string("/fault/") + fault + "?on=0")->status, 200) << fault;
  }
  EXPECT_THAT(client.Post("/fault/nose?on=1")->body, HasSubstr("cut, late, estop"));
  EXPECT_EQ(client.Post("/fault/nose?on=1")->status, 400);
  EXPECT_EQ(client.Post("/fault/base")->status, 400);
}

TEST_F(PioneerSimProcess, StopsWhenItIsToldTo)
{
  SimProcess sim(arguments());
  EXPECT_EQ(sim.end(SIGTERM), 0);
}

/** What it says when it refuses, and its exit status. */
std::pair<std::string, int> refusal(const std::string &options)
{
  const std::string command = std::string(HOMEWARD_PIONEER_SIM) + " " + options + " 2>&1";
  FILE *pipe = ::popen(command.c_str(), "r");
  std::array<char, 512> line{};
  std::string text;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    text += line.data();
  }
  return {text, WEXITSTATUS(::pclose(pipe))};
}

TEST_F(PioneerSimProcess, BadArgumentsEndInOneClearLine)
{
  const std::string taken = "--port " + sSim->arcosTcp().substr(14);
  for (const auto &[options, culprit] :
       std::vector<std::pair<std::string, std::string>>{{"--world nowhere.sdf", "nowhere.sdf"},
                                                        {"--light noon", "noon"},
                                                        {"--subclass p9", "p9"},
                                                        {"--host nowhere", "nowhere"},
                                                        {"--start 500,0,0", "500"},
                                                        {taken, "cannot listen"}}) {
    const auto [text, status] = refusal(options);
    EXPECT_THAT(text, HasSubstr(culprit));
    EXPECT_GT(status, 0) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
}

} // namespace
} // namespace homeward
