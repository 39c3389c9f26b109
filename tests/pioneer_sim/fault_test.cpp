// SPDX-License-Identifier: GPL-3.0-or-later
#include "../drivers/fake_device.h"
#include "sim_process.h"
#include "test_paths.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/camera_sources.h>
#include <homeward/drivers/live_camera.h>
#include <homeward/drivers/pioneer_base.h>
#include <homeward/drivers/sick_laser.h>
#include <homeward/pilot/motion.h>

#include <cstdio>
#include <fstream>
#include <gmock/gmock.h>
#include <httplib.h>
#include <sstream>

namespace homeward
{
namespace
{

using Wall = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/** Silence that is noticed, and what may pass from there to the zero command. */
constexpr double kSilence = 0.3;
constexpr double kZeroWithin = 0.3;
/** What a machine that is busy with other things may add. */
constexpr double kSlack = 0.2;
/** From 0.3 m/s at 0.5 m/s^2, and the information packet that tells of it. */
constexpr double kBraking = 0.8;

/** When velocities went over a line. */
class Wire
{
public:
  void note(std::span<const std::uint8_t> bytes)
  {
    const std::lock_guard lock(m_mutex);
    ArcosReader reader;
    reader.push(bytes, Time{});
    while (const auto packet = reader.next()) {
      if (packet->id == static_cast<std::uint8_t>(ArcosCommand::Vel)) {
        m_last = arcosArgument(*packet).value_or(0);
        if (m_last == 0 && !m_zero) {
          m_zero = Wall::now();
        }
      }
    }
  }

  void forgetZero()
  {
    const std::lock_guard lock(m_mutex);
    m_zero.reset();
  }

  /** The first zero velocity since forgetZero(). */
  std::optional<Wall::time_point> zero() const
  {
    const std::lock_guard lock(m_mutex);
    return m_zero;
  }

  int last() const
  {
    const std::lock_guard lock(m_mutex);
    return m_last;
  }

private:
  mutable std::mutex m_mutex;
  std::optional<Wall::time_point> m_zero;
  int m_last = 0;
};

/** A stream whose writes are noted. */
class TappedStream final : public ByteStream
{
public:
  TappedStream(std::unique_ptr<ByteStream> stream, Wire &wire)
      : m_stream(std::move(stream)), m_wire(wire)
  {}
  std::size_t read(std::span<std::uint8_t> into, Duration timeout) override
  {
    return m_stream->read(into, timeout);
  }
  void write(std::span<const std::uint8_t> bytes) override
  {
    m_stream->write(bytes);
    m_wire.note(bytes);
  }
  void setBaud(int baud) override { m_stream->setBaud(baud); }

private:
  std::unique_ptr<ByteStream> m_stream;
  Wire &m_wire;
};

RobotDescription pioneer()
{
  const auto file = dataDir() / "robots/pioneer3at.urdf";
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return parseRobotDescription(text.str(), file.string());
}

std::vector<std::string> inTheContractRoom()
{
  const auto room =
      std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/contract/contract_room.sdf";
  return {"--world", room.string(), "--start", "2,5,0", "--threads", "1", "--frame-rate", "10"};
}

/** A robot that drives ahead in real time, and the ways to spoil that. */
class Fault : public testing::Test
{
protected:
  void connect(bool lms = false)
  {
    PioneerOptions options;
    options.limits = {0.4, radians(40.0), 0.3, 0.5, radians(100.0)};
    options.laser = lms ? PioneerLaser::None : PioneerLaser::Plain;
    m_camera = std::make_unique<LiveCamera>(openStreamCamera(m_sim.stream()), CaptureOptions{});
    if (lms) {
      m_lms = std::make_unique<SickLaser>(openStream(m_sim.lmsPty(), 9600), SickOptions{});
    }
    m_base = std::make_unique<PioneerBase>(
        std::make_unique<TappedStream>(openStream(m_sim.arcosTcp(), 9600), m_wire), options);
    LaserScanner &laser = lms ? static_cast<LaserScanner &>(*m_lms) : m_base->laser();
    ASSERT_TRUE(soon([&] { return laser.scan().has_value(); }));
    MotionOptions motion;
    motion.baseSilence = motion.laserSilence = motion.cameraSilence = kSilence;
    motion.lostSeconds = 2.0;
    m_motion = std::make_unique<Motion>(Devices{m_clock, *m_base, laser, *m_camera}, pioneer(),
                                        motion, m_stop);
    driveFor(1.5);
    ASSERT_EQ(m_wire.last(), 300);
  }

  void driveFor(double seconds)
  {
    const auto begin = Wall::now();
    while (Seconds(Wall::now() - begin).count() < seconds) {
      m_motion->tick();
      m_motion->follow({0.3, 0.0}, 0.0);
    }
    m_wire.forgetZero();
  }

  /** Drives on until the motion gives up. @return what it says then */
  std::string driveUntilItGivesUp()
  {
    try {
      driveFor(10.0);
    }
    catch (const DeviceError &error) {
      return error.what();
    }
    catch (const StopRequested &) {
      return "stopped";
    }
    return {};
  }

  void set(const std::string &fault, bool on = true)
  {
    httplib::Client client("127.0.0.1", m_sim.httpPort());
    const auto answer = client.Post("/fault/" + fault + (on ? "?on=1" : "?on=0"));
    ASSERT_TRUE(answer && answer->status == 200);
    m_fault = Wall::now();
  }

  double truth(const char *key) const
  {
    httplib::Client client("127.0.0.1", m_sim.httpPort());
    const auto answer = client.Get("/truth");
    return answer ? nlohmann::json::parse(answer->body)[key].get<double>() : -1.0;
  }

  /** Watches when the robot stands, until stopped. */
  void watchForRest()
  {
    m_watcher = std::jthread([this](const std::stop_token &stop) {
      httplib::Client client("127.0.0.1", m_sim.httpPort());
      client.set_keep_alive(true);
      while (!stop.stop_requested() && !m_rest) {
        const auto answer = client.Get("/truth");
        if (answer && nlohmann::json::parse(answer->body)["v_m_s"] == 0.0) {
          m_rest = Wall::now();
        }
      }
    });
  }

  /** Checks and prints how long it took. @param silence of the device before anybody can know */
  void expectZeroAndRest(const char *name, double silence)
  {
    ASSERT_TRUE(m_wire.zero());
    EXPECT_TRUE(soon([this] { return m_rest.load().has_value(); }));
    m_watcher = {};
    const double zero = Seconds(*m_wire.zero() - m_fault).count();
    const double rest = Seconds(*m_rest.load() - m_fault).count();
    std::printf("| %s | %.2f | %.2f |\n", name, zero, rest);
    EXPECT_LE(zero, silence + kZeroWithin + kSlack);
    EXPECT_LE(rest, zero + kBraking + kSlack);
    EXPECT_EQ(truth("collisions"), 0.0);
  }

  /** A fault of pioneer-sim's that silences a device. */
  void silence(const char *fault, const char *device, const char *name, bool lms = false)
  {
    connect(lms);
    set(fault);
    watchForRest();
    EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr(device));
    expectZeroAndRest(name, kSilence);
  }

  struct Instant
  {
    std::optional<Wall::time_point> load() const
    {
      const std::lock_guard lock(mutex);
      return at;
    }
    explicit operator bool() const { return load().has_value(); }
    Instant &operator=(Wall::time_point instant)
    {
      const std::lock_guard lock(mutex);
      at = instant;
      return *this;
    }
    bool operator!() const { return !load().has_value(); }
    mutable std::mutex mutex;
    std::optional<Wall::time_point> at;
  };

  SimProcess m_sim{inTheContractRoom()};
  SteadyClock m_clock;
  Wire m_wire;
  std::atomic<bool> m_stop{false};
  std::unique_ptr<LiveCamera> m_camera;
  std::unique_ptr<SickLaser> m_lms;
  std::unique_ptr<PioneerBase> m_base;
  std::unique_ptr<Motion> m_motion;
  Wall::time_point m_fault;
  Instant m_rest;
  std::jthread m_watcher;
};

TEST_F(Fault, SilentBase)
{
  silence("base", "has been silent", "base sends no packets");
}

TEST_F(Fault, HalfPackets)
{
  silence("half", "has been silent", "base sends half packets");
}

TEST_F(Fault, SilentLaserOnTheBase)
{
  silence("laser", "laser", "laser silent, on the base's connection");
}

TEST_F(Fault, SilentLaserOnItsOwnLine)
{
  silence("laser", "laser", "LMS-200 silent", true);
}

TEST_F(Fault, SilentCamera)
{
  silence("camera", "camera", "camera sends no pictures");
}

TEST_F(Fault, FrozenCamera)
{
  silence("frozen", "camera", "camera frozen");
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

TEST_F(Fault, TheWholeRobotHangs)
{
  connect();
  m_sim.signal(SIGSTOP);
  m_fault = Wall::now();
  const std::string said = driveUntilItGivesUp();
  EXPECT_FALSE(said.empty());
  ASSERT_TRUE(m_wire.zero());
  const double zero = Seconds(*m_wire.zero() - m_fault).count();
  std::printf("| the whole robot hangs | %.2f | |\n", zero);
  EXPECT_LE(zero, kSilence + kZeroWithin + kSlack);
  m_sim.signal(SIGCONT);
  EXPECT_TRUE(soon([this] { return truth("v_m_s") == 0.0; }));
}

TEST_F(Fault, TheRobotIsKilled)
{
  connect();
  m_sim.end(SIGKILL);
  m_fault = Wall::now();
  EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr("is lost"));
  const double noticed = Seconds(Wall::now() - m_fault).count();
  std::printf("| the robot is killed: noticed | %.2f | |\n", noticed);
  EXPECT_LE(noticed, kZeroWithin + kSlack);
}

TEST_F(Fault, TheControlLoopHangs)
{
  connect();
  m_fault = Wall::now();
  watchForRest();
  ASSERT_TRUE(soon([this] { return m_wire.zero().has_value(); })); // nobody ticks
  expectZeroAndRest("the control loop hangs", kSilence);
}

TEST_F(Fault, SomebodyStopsIt)
{
  connect();
  m_stop = true;
  m_fault = Wall::now();
  watchForRest();
  EXPECT_EQ(driveUntilItGivesUp(), "stopped");
  expectZeroAndRest("stop is asked for (Ctrl-C, a lost terminal)", 0.0);
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
    expectZeroAndRest("an exception above the control loop", 0.0);
  }
}

/** Drives in a process of its own, which is killed: its sockets close, its serial line stays. */
class KilledClient : public Fault
{
protected:
  double restAfterKill(const std::string &address)
  {
    const pid_t client = ::fork();
    if (client == 0) {
      PioneerOptions options;
      options.limits = {0.4, radians(40.0), 0.3, 0.5, radians(100.0)};
      PioneerBase base(openStream(address, 9600), options);
      SteadyClock clock;
      while (true) {
        base.drive({0.3, 0.0});
        clock.sleepUntil(clock.now() + std::chrono::milliseconds(100));
      }
    }
    EXPECT_TRUE(soon([this] { return truth("v_m_s") > 0.25; }));
    ::kill(client, SIGKILL);
    m_fault = Wall::now();
    ::waitpid(client, nullptr, 0);
    EXPECT_TRUE(soon([this] { return truth("v_m_s") == 0.0; }));
    return Seconds(Wall::now() - m_fault).count();
  }
};

TEST_F(KilledClient, OverTcp)
{
  const double rest = restAfterKill(m_sim.arcosTcp());
  std::printf("| the client is killed, over TCP | | %.2f |\n", rest);
  EXPECT_LE(rest, kBraking + kSlack);
}

TEST_F(KilledClient, OverASerialLine)
{
  const double rest = restAfterKill(m_sim.arcosPty());
  std::printf("| the client is killed, over a serial line | | %.2f |\n", rest);
  EXPECT_LE(rest, 2.0 + kBraking + kSlack); // the robot's own watchdog
}

} // namespace
} // namespace homeward
