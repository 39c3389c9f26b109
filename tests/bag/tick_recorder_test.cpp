// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.h"

#include <homeward/bag/bag_reader.h>
#include <homeward/bag/bag_repair.h>
#include <homeward/bag/tick_reader.h>
#include <homeward/bag/tick_recorder.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <sys/wait.h>

#include <csignal>

namespace homeward
{
namespace
{

constexpr const char *kSetup = R"({"mission":{"command":"none"}})";

/** Numbers that no decimal with few digits is. */
class Ticks
{
public:
  /** A tick of all there is, with a picture of noise. */
  Tick next()
  {
    Tick tick;
    m_now += fromSeconds(0.1);
    tick.instants = {{m_now, 3}, {m_now + Duration(17), 1}};
    tick.counted = {true, false};
    BaseState state;
    state.stamp = m_now - Duration(1);
    state.odometry = {m_random.uniform(-9.0, 9.0), m_random.uniform(-9.0, 9.0),
                      m_random.uniform(-kPi, kPi)};
    state.velocity = {m_random.uniform(-1.0, 1.0), m_random.uniform(-1.0, 1.0)};
    state.stalled = true;
    state.bumpedBehind = true;
    state.halt = "its \"button\" is pressed";
    state.sonar = {{1.0 / 3.0, 0.1, 0.2, m_random.uniform(0.0, 5.0)},
                   {0.0, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}};
    tick.states = {state, state};
    Scan scan{m_now - Duration(2), -kPi / 2.0, radians(1.0), 8.1, {1.0F, kUnknownRange, 1e9F}};
    tick.scans = {std::nullopt, scan, scan};
    cv::Mat picture(48, 64, CV_8UC3);
    for (int i = 0; i < picture.rows * picture.cols * 3; ++i) {
      picture.data[i] = static_cast<unsigned char>(m_random.uniform(0.0, 255.0));
    }
    tick.frames = {Frame{m_now, picture}, Frame{m_now, picture}, std::nullopt};
    tick.newest = {std::nullopt, m_now};
    tick.commands = {{m_random.uniform(-1.0, 1.0), 1.0 / 3.0}, {0.0, 0.0}};
    tick.faults = {{Device::Laser, 4, "it is gone"}};
    tick.notes = {R"({"event":"step","lines":["a \\ b"]})"};
    tick.stopAfter = 5;
    return tick;
  }

private:
  Time m_now{};
  Random m_random{1, 0};
};

void expectSame(const BaseState &a, const BaseState &b)
{
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.odometry.x, b.odometry.x);
  EXPECT_EQ(a.odometry.y, b.odometry.y);
  EXPECT_EQ(a.odometry.heading, b.odometry.heading);
  EXPECT_EQ(a.velocity.v, b.velocity.v);
  EXPECT_EQ(a.velocity.w, b.velocity.w);
  EXPECT_EQ(a.stalled, b.stalled);
  EXPECT_EQ(a.bumpedAhead, b.bumpedAhead);
  EXPECT_EQ(a.bumpedBehind, b.bumpedBehind);
  EXPECT_EQ(a.halt, b.halt);
  ASSERT_EQ(a.sonar.size(), b.sonar.size());
  EXPECT_EQ(a.sonar.front().range, b.sonar.front().range);
  EXPECT_TRUE(std::isnan(b.sonar.back().range));
}

void expectSame(const Scan &a, const Scan &b)
{
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.angleMin, b.angleMin);
  EXPECT_EQ(a.angleStep, b.angleStep);
  EXPECT_EQ(a.rangeMax, b.rangeMax);
  ASSERT_EQ(a.ranges.size(), b.ranges.size());
  EXPECT_EQ(a.ranges[0], b.ranges[0]);
  EXPECT_TRUE(std::isnan(b.ranges[1]));
  EXPECT_EQ(a.ranges[2], b.ranges[2]);
}

void expectSame(const Tick &a, const Tick &b)
{
  ASSERT_EQ(a.instants.size(), b.instants.size());
  for (std::size_t i = 0; i < a.instants.size(); ++i) {
    EXPECT_EQ(a.instants[i].at, b.instants[i].at);
    EXPECT_EQ(a.instants[i].times, b.instants[i].times);
  }
  EXPECT_EQ(a.counted, b.counted);
  EXPECT_EQ(a.newest, b.newest);
  EXPECT_EQ(a.stopAfter, b.stopAfter);
  EXPECT_EQ(a.last, b.last);
  ASSERT_EQ(a.states.size(), b.states.size());
  ASSERT_EQ(a.scans.size(), b.scans.size());
  ASSERT_EQ(a.frames.size(), b.frames.size());
  ASSERT_EQ(a.commands.size(), b.commands.size());
  ASSERT_EQ(a.faults.size(), b.faults.size());
  EXPECT_EQ(a.faults[0].device, b.faults[0].device);
  EXPECT_EQ(a.faults[0].call, b.faults[0].call);
  EXPECT_EQ(a.faults[0].what, b.faults[0].what);
  expectSame(a.states[1], b.states[1]);
  EXPECT_FALSE(b.scans[0]);
  expectSame(*a.scans[1], *b.scans[1]);
  expectSame(*a.scans[2], *b.scans[2]);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(a.commands[i].v, b.commands[i].v);
    EXPECT_EQ(a.commands[i].w, b.commands[i].w);
    EXPECT_EQ(a.frames[i]->stamp, b.frames[i]->stamp);
    EXPECT_EQ(cv::norm(a.frames[i]->image, b.frames[i]->image, cv::NORM_INF), 0.0);
  }
  EXPECT_FALSE(b.frames[2]);
}

class TickRecorderTest : public testing::Test
{
protected:
  /** Records so many ticks. */
  RecordingCounts record(int ticks, const RecorderOptions &options) const
  {
    TickRecorder recorder(bag, kSetup, options);
    Ticks source;
    for (int i = 0; i < ticks; ++i) {
      recorder.keep(source.next());
    }
    return recorder.finish();
  }

  /** Reads them back; how many there are. */
  int expectTicks() const
  {
    TickReader reader(bagParts(bag));
    EXPECT_EQ(reader.setup(), kSetup);
    Ticks source;
    int count = 0;
    for (; const std::optional<Tick> tick = reader.next(); ++count) {
      expectSame(source.next(), *tick);
    }
    return count;
  }

  Folder folder;
  std::string bag = folder / "drive.bag";
};

TEST_F(TickRecorderTest, KeepsEveryDigit)
{
  const RecordingCounts counts = record(5, {});
  EXPECT_EQ(counts.ticks, 5U);
  EXPECT_EQ(counts.bytes, std::filesystem::file_size(bag));
  EXPECT_EQ(expectTicks(), 5);
}

TEST_F(TickRecorderTest, SplitsBySize)
{
  RecorderOptions options;
  options.fileBytes = 30'000;
  record(12, options);
  EXPECT_GE(bagParts(bag).size(), 3U);
  EXPECT_LT(std::filesystem::file_size(bag), 100'000U);
  EXPECT_EQ(expectTicks(), 12);
}

TEST_F(TickRecorderTest, RefusesABagThatIsThere)
{
  record(1, {});
  EXPECT_THROW(record(1, {}), StoreError);
}

TEST_F(TickRecorderTest, RefusesAPartOfAnotherRecording)
{
  record(1, {});
  std::filesystem::copy_file(bag, folder / "drive_1.bag");
  EXPECT_THROW(expectTicks(), StoreError);
}

TEST_F(TickRecorderTest, LosesPicturesFirstAndCountsThem)
{
  RecorderOptions options;
  options.waitingBytes = 10'000; // one picture does not fit
  const RecordingCounts counts = record(1, options);
  EXPECT_EQ(counts.lostPictures, 2U);
  EXPECT_EQ(counts.ticks, 1U);
  TickReader reader(bagParts(bag));
  EXPECT_TRUE(reader.next()->frames[0]->image.empty());
}

TEST_F(TickRecorderTest, WaitsForRoomWhereItMay)
{
  RecorderOptions options;
  options.waitingBytes = 40'000;
  options.mayWait = true;
  const RecordingCounts counts = record(50, options);
  EXPECT_EQ(counts.lostPictures, 0U);
  EXPECT_EQ(counts.ticks, 50U);
}

TEST_F(TickRecorderTest, RefusesAFolderThatIsNotThere)
{
  EXPECT_THROW(TickRecorder(folder / "missing/drive.bag", kSetup, {}), StoreError);
}

/** Records in a process that is killed when the bag has so many bytes. */
void recordAndDie(const std::string &bag, std::uintmax_t bytes)
{
  const pid_t child = fork();
  if (child == 0) {
    RecorderOptions options;
    options.mayWait = true;
    TickRecorder recorder(bag, kSetup, options);
    Ticks source;
    while (std::filesystem::file_size(bag) < bytes) {
      recorder.keep(source.next());
    }
    std::raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST_F(TickRecorderTest, IsRepairedUpToTheLastClosedChunkAfterAKill)
{
  recordAndDie(bag, 2'500'000);
  EXPECT_THROW(BagReader{bag}, StoreError);
  const BagRepair repair = repairBag(bag);
  EXPECT_TRUE(repair.needed);
  EXPECT_GE(repair.chunks, 3U);
  EXPECT_GT(repair.cutBytes, 0U);
  EXPECT_LT(repair.cutBytes, 800'000U);
  // Each tick has a picture of 9 kB, noise.
  EXPECT_GT(expectTicks(), 150);
  EXPECT_FALSE(repairBag(bag).needed);
}

TEST_F(TickRecorderTest, IsRepairedWhereverItBreaksOff)
{
  recordAndDie(bag, 1'700'000);
  const std::uintmax_t size = std::filesystem::file_size(bag);
  for (const std::uintmax_t cut : {1U, 5'000U, 100'000U, 600'000U}) {
    const std::string copy = folder / "cut.bag";
    std::filesystem::copy_file(bag, copy, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(copy, size - cut);
    EXPECT_GE(repairBag(copy).chunks, 1U) << cut;
    TickReader reader({copy});
    EXPECT_TRUE(reader.next()) << cut;
  }
  std::filesystem::resize_file(bag, 100'000);
  EXPECT_THROW(repairBag(bag), StoreError);
  EXPECT_EQ(std::filesystem::file_size(bag), 100'000U);
}

} // namespace
} // namespace homeward
