// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that goes and comes back, behind a socket and behind a serial line.
#include "../drivers/fake_device.h"
#include "folder.h"
#include "sim_process.h"
#include "test_paths.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/reconnect.h>

#include <gmock/gmock.h>
#include <httplib.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;
using Wall = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

class Reconnect : public testing::TestWithParam<std::string>
{
protected:
  Reconnect() { powerOn(0); }

  void powerOn(int port)
  {
    const auto room =
        std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/contract/contract_room.sdf";
    m_sim = std::make_unique<SimProcess>(
        std::vector<std::string>{"--world", room.string(), "--start", "4,5,0", "--threads", "1",
                                 "--links", m_folder / "", "--port", std::to_string(port)});
    m_port = std::stoi(m_sim->arcosTcp().substr(std::string("tcp:127.0.0.1:").size()));
  }

  void powerOff() { m_sim->end(SIGKILL); }

  std::unique_ptr<ByteStream> open() const
  {
    return openStream(GetParam() == "Tcp" ? "tcp:127.0.0.1:" + std::to_string(m_port)
                                          : m_folder / "pioneer",
                      9600);
  }

  static PioneerOptions options()
  {
    PioneerOptions options;
    options.limits = {0.4, radians(40.0), 0.3, 0.5, radians(100.0)};
    return options;
  }

  double speed() const
  {
    httplib::Client client("127.0.0.1", m_sim->httpPort());
    const auto answer = client.Get("/truth");
    return answer ? nlohmann::json::parse(answer->body)["v_m_s"].get<double>() : 99.0;
  }

  /** Drives on as a control loop does that heeds no fault. @return what the last one said */
  std::string driveFor(PioneerBase &base, double seconds)
  {
    std::string said;
    for (const auto begin = Wall::now(); Seconds(Wall::now() - begin).count() < seconds;) {
      try {
        base.drive({0.2, 0.0});
      }
      catch (const DeviceError &error) {
        said = error.what();
      }
      m_clock.sleepUntil(m_clock.now() + std::chrono::milliseconds(50));
    }
    return said;
  }

  void expectItStandsUntilAskedToDrive(PioneerBase &base)
  {
    EXPECT_THAT(base.state().halt, HasSubstr("link"));
    EXPECT_THAT(driveFor(base, 1.0), HasSubstr("does not drive"));
    EXPECT_EQ(speed(), 0.0);
    base.enableMotors();
    EXPECT_EQ(driveFor(base, 1.0), "");
    EXPECT_GT(speed(), 0.1);
  }

  Folder m_folder;
  int m_port = 0;
  std::unique_ptr<SimProcess> m_sim;
  SteadyClock m_clock;
  std::atomic<bool> m_stop{false};
};

INSTANTIATE_TEST_SUITE_P(Over, Reconnect, testing::Values("Tcp", "Serial"),
                         [](const auto &each) { return each.param; });

TEST_P(Reconnect, APowerCycledRobotIsFoundAgainAndStandsUntilAskedToDrive)
{
  PioneerBase base(open(), options());
  EXPECT_EQ(driveFor(base, 1.0), "");
  EXPECT_GT(speed(), 0.1);
  const double before = base.state().odometry.x;
  powerOff();
  const auto off = Wall::now();
  EXPECT_TRUE(soon([&] {
    try {
      base.state();
      return false;
    }
    catch (const DeviceError &) {
      return true;
    }
  }));
  const double noticed = Seconds(Wall::now() - off).count();
  EXPECT_LT(noticed, 0.5);

  std::vector<std::string> said;
  const auto say = [&](const std::string &text) { said.push_back(text); };
  ReconnectOptions retry;
  retry.tries = 2;
  retry.pause = std::chrono::milliseconds(50);
  const auto openAgain = [this] { return open(); };
  EXPECT_THROW(reconnect(base, openAgain, retry, m_stop, say), DeviceError);
  EXPECT_EQ(said.size(), 2U);

  retry.tries = 40;
  retry.longestPause = std::chrono::milliseconds(500);
  const auto begin = Wall::now();
  std::atomic<bool> back{false};
  std::jthread operatorsHand(
      [&] { back = reconnect(base, openAgain, retry, m_stop, say); }); // while it is off
  m_clock.sleepUntil(m_clock.now() + std::chrono::milliseconds(700));
  powerOn(m_port); // ends with the thread that starts it
  operatorsHand.join();
  ASSERT_TRUE(back);
  std::printf("| link over %s: lost after %.2f s, back %.2f s after it was cut | %zu tries |\n",
              GetParam().c_str(), noticed, Seconds(Wall::now() - begin).count(), said.size() - 2);
  EXPECT_NEAR(base.state().odometry.x, before, 0.1);
  expectItStandsUntilAskedToDrive(base);
}

TEST_P(Reconnect, ARobotThatHungIsFoundAgainWhereItWasLeftOpen)
{
  PioneerOptions quick = options();
  quick.answerTimeout = std::chrono::milliseconds(300);
  PioneerBase base(open(), quick);
  EXPECT_EQ(driveFor(base, 0.5), "");
  m_sim->signal(SIGSTOP);
  EXPECT_THAT(driveFor(base, 2.5), HasSubstr("silent"));
  std::jthread hand([this] {
    m_clock.sleepUntil(m_clock.now() + std::chrono::milliseconds(700));
    m_sim->signal(SIGCONT);
  });
  ReconnectOptions retry;
  retry.tries = 10;
  ASSERT_TRUE(reconnect(
      base, [this] { return open(); }, retry, m_stop, [](const std::string &) {}));
  hand.join();
  expectItStandsUntilAskedToDrive(base);
}

} // namespace
} // namespace homeward
