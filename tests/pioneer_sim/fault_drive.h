// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

using Wall = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/** Silence that is noticed: three periods of a device. */
inline constexpr double kSilence = 0.3;
/** What may pass from what is noticed to the zero command. */
inline constexpr double kZeroWithin = 0.3;
/** Without a command the robot stops by itself. */
inline constexpr double kOwnWatchdog = 2.0;
/** What a machine that is busy with other things may add. */
inline constexpr double kSlack = 0.2;
/** From 0.3 m/s at 0.5 m/s^2, and the information packet that tells of it. */
inline constexpr double kBraking = 0.8;

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
      const int argument = arcosArgument(*packet).value_or(0);
      if (packet->id == static_cast<std::uint8_t>(ArcosCommand::Vel)) {
        m_last = argument;
      }
      else if (packet->id == static_cast<std::uint8_t>(ArcosCommand::RVel) && argument == 0 &&
               m_last == 0 && !m_zero) {
        m_zero = Wall::now();
      }
    }
  }

  void forgetZero()
  {
    const std::lock_guard lock(m_mutex);
    m_zero.reset();
  }

  /** The first zero velocity since forgetZero(), of translation and rotation. */
  std::optional<Wall::time_point> zero() const
  {
    const std::lock_guard lock(m_mutex);
    return m_zero;
  }

  /** Translation, mm/s. */
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

inline RobotDescription pioneer()
{
  const auto file = dataDir() / "robots/pioneer3at.urdf";
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return parseRobotDescription(text.str(), file.string());
}

/** 2.2 m before a wall: who does not stop runs into it. */
inline std::vector<std::string> inTheContractRoom()
{
  const auto room =
      std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/contract/contract_room.sdf";
  return {"--world", room.string(), "--start", "7.5,5,0", "--threads", "1", "--frame-rate", "10"};
}

/** An instant that one thread notes and another asks for. */
class Instant
{
public:
  std::optional<Wall::time_point> get() const
  {
    const std::lock_guard lock(m_mutex);
    return m_at;
  }
  void set(Wall::time_point instant)
  {
    const std::lock_guard lock(m_mutex);
    m_at = instant;
  }

private:
  mutable std::mutex m_mutex;
  std::optional<Wall::time_point> m_at;
};

/**
 * A robot that drives ahead in real time, and the ways to spoil that. What a test measures is
 * recorded as properties, of which scripts/fault-table makes doc/faults.md.
 */
class Fault : public testing::Test
{
protected:
  /** How the robot's devices are reached. */
  struct Links
  {
    std::string base;
    std::string laser; ///< empty: it is on the base's connection
  };

  static PioneerOptions pioneerOptions()
  {
    PioneerOptions options;
    options.limits = {0.4, radians(40.0), 0.3, 0.5, radians(100.0)};
    return options;
  }

  void connect(const Links &links)
  {
    PioneerOptions options = pioneerOptions();
    options.laser = links.laser.empty() ? PioneerLaser::Plain : PioneerLaser::None;
    m_camera = std::make_unique<LiveCamera>(openStreamCamera(m_sim.stream()), CaptureOptions{});
    if (!links.laser.empty()) {
      m_lms = std::make_unique<SickLaser>(openStream(links.laser, 9600), SickOptions{});
    }
    m_base = std::make_unique<PioneerBase>(
        std::make_unique<TappedStream>(openStream(links.base, 9600), m_wire), options);
    LaserScanner &laser = m_lms ? static_cast<LaserScanner &>(*m_lms) : m_base->laser();
    ASSERT_TRUE(soon([&] { return laser.scan().has_value(); }));
    MotionOptions motion;
    motion.baseSilence = motion.laserSilence = motion.cameraSilence = kSilence;
    motion.lostSeconds = 2.0;
    m_motion = std::make_unique<Motion>(Devices{m_clock, *m_base, laser, *m_camera}, pioneer(),
                                        motion, m_stop);
    driveFor(1.5);
    ASSERT_EQ(m_wire.last(), 300);
  }

  void connect() { connect({m_sim.arcosTcp(), ""}); }

  void driveFor(double seconds)
  {
    const auto begin = Wall::now();
    while (Seconds(Wall::now() - begin).count() < seconds) {
      m_motion->tick();
      m_motion->follow({0.3, 0.0}, 0.0);
    }
    m_wire.forgetZero();
  }

  /** Calls until the motion gives up, for 10 s at most. @return what it says then */
  std::string untilItGivesUp(const std::function<void()> &act)
  {
    try {
      for (const auto begin = Wall::now(); Seconds(Wall::now() - begin).count() < 10.0;) {
        act();
      }
    }
    catch (const DeviceError &error) {
      return error.what();
    }
    catch (const StopRequested &) {
      return "stopped";
    }
    return {};
  }

  std::string driveUntilItGivesUp()
  {
    return untilItGivesUp([this] {
      m_motion->tick();
      m_motion->follow({0.3, 0.0}, 0.0);
    });
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

  /** Watches when the robot no longer drives on, until stopped. */
  void watchForRest()
  {
    m_watcher = std::jthread([this](const std::stop_token &stop) {
      httplib::Client client("127.0.0.1", m_sim.httpPort());
      client.set_keep_alive(true);
      while (!stop.stop_requested() && !m_rest.get()) {
        const auto answer = client.Get("/truth");
        if (answer) {
          const auto truth = nlohmann::json::parse(answer->body);
          if (truth["v_m_s"] <= 0.0 && truth["w_rad_s"] == 0.0) {
            m_rest.set(Wall::now());
          }
        }
      }
    });
  }

  /** Checks, prints and records seconds from the fault to `what`: "zero", "rest" or "noticed". */
  void expectWithin(const std::string &what, Wall::time_point instant, double bound)
  {
    const double seconds = Seconds(instant - m_fault).count();
    std::printf("%s after %.2f s, at most %.1f\n", what.c_str(), seconds, bound);
    EXPECT_LE(seconds, bound + kSlack) << what;
    RecordProperty(what, asText(seconds, "%.2f"));
    RecordProperty(what + "_bound", asText(bound, "%.1f"));
  }

  /** The robot came to rest within `bound` seconds of the fault and touched nothing. */
  void expectRest(double bound)
  {
    EXPECT_TRUE(soon([this] { return m_rest.get().has_value(); }));
    m_watcher = {};
    ASSERT_TRUE(m_rest.get());
    expectWithin("rest", *m_rest.get(), bound);
    EXPECT_EQ(truth("collisions"), 0.0);
  }

  /** What the table calls the fault. */
  void name(const std::string &fault) { RecordProperty("fault", fault); }

  /** @param bound seconds from the fault to the zero command */
  void expectZeroAndRest(const char *fault, double bound)
  {
    name(fault);
    ASSERT_TRUE(m_wire.zero());
    expectWithin("zero", *m_wire.zero(), bound);
    expectRest(bound + kBraking);
  }

  /** A fault of pioneer-sim's that silences a device. */
  void silence(const char *fault, const char *complaint, const char *name)
  {
    set(fault);
    watchForRest();
    EXPECT_THAT(driveUntilItGivesUp(), testing::HasSubstr(complaint));
    expectZeroAndRest(name, kSilence + kZeroWithin);
  }

  static std::string asText(double value, const char *format)
  {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
  }

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

} // namespace homeward
