// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/record/recording_devices.h>
#include <homeward/record/replayed_devices.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <deque>

namespace homeward
{
namespace
{

/** A robot that counts: time goes on with every look at it, and everything that can fail does when
 * it is told to. */
class CountingRobot final : public Clock, public MobileBase, public LaserScanner, public ImageSource
{
public:
  bool fails = false;

  Time now() const override { return Time(Duration(++m_now)); }
  void sleepUntil(Time instant) override { m_now = instant.time_since_epoch().count(); }
  void drive(const Twist2 & /*twist*/) override { expectSound(); }

  BaseState state() override
  {
    expectSound();
    BaseState state;
    state.odometry.x = static_cast<double>(++m_reads) / 3.0;
    return state;
  }

  std::optional<Scan> scan() override
  {
    return ++m_reads % 2 == 0 ? std::nullopt
                              : std::optional(Scan{Time(Duration(m_reads)), 0.0, 0.0, 0.0, {}});
  }

  std::optional<Frame> grab() override
  {
    m_picture.setTo(++m_reads); // one picture, written anew again and again
    return Frame{Time(Duration(m_reads)), m_picture};
  }

  std::optional<Time> newest() const override { return Time(Duration(m_reads)); }

private:
  void expectSound() const
  {
    if (fails) {
      throw DeviceError("it counts no more");
    }
  }

  mutable std::int64_t m_now = 0;
  int m_reads = 0;
  cv::Mat m_picture{2, 2, CV_8UC1};
};

/** All that a program saw, as text. */
std::string see(Clock &clock, MobileBase &base, LaserScanner &laser, ImageSource &camera, int ticks)
{
  std::string seen;
  const auto add = [&](auto value) { seen += std::to_string(value) + " "; };
  for (int tick = 1; tick <= ticks; ++tick) {
    add(clock.now().time_since_epoch().count());
    add(base.state().odometry.x);
    add(clock.now().time_since_epoch().count());
    add(laser.scan() ? 1 : 0);
    const Frame frame = *camera.grab();
    add(frame.stamp.time_since_epoch().count());
    add(cv::sum(frame.image)[0]);
    add(camera.newest()->time_since_epoch().count());
    add(clock.counts(tick % 3 == 0) ? 1 : 0);
    base.drive({0.1 * tick, 0.0});
    clock.sleepUntil(Time(Duration(1000 * tick)));
  }
  return seen;
}

class RecordingDevicesTest : public testing::Test
{
protected:
  ReplayedDevices replay()
  {
    return {[this]() -> std::optional<Tick> {
              if (ticks.empty()) {
                return std::nullopt;
              }
              Tick tick = std::move(ticks.front());
              ticks.pop_front();
              return tick;
            },
            [this] { stopped = true; }};
  }

  static std::string see(RecordingDevices &from, int count)
  {
    return homeward::see(from.clock(), from.base(), from.laser(), from.camera(), count);
  }

  static std::string see(ReplayedDevices &from, int count)
  {
    return homeward::see(from.clock(), from.base(), from.laser(), from.camera(), count);
  }

  std::atomic<bool> stop = false;
  bool stopped = false;
  std::deque<Tick> ticks;
  CountingRobot robot;
  RecordingDevices recording{robot, robot, robot,
                             robot, stop,  [this](Tick tick) { ticks.push_back(std::move(tick)); }};
};

TEST_F(RecordingDevicesTest, ChangeNothingOfWhatIsSeen)
{
  CountingRobot alone;
  EXPECT_EQ(see(recording, 5), homeward::see(alone, alone, alone, alone, 5));
}

TEST_F(RecordingDevicesTest, AreSeenAgainAsTheyWere)
{
  const std::string seen = see(recording, 5);
  recording.finish();
  ReplayedDevices replayed = replay();
  EXPECT_EQ(see(replayed, 5), seen);
  EXPECT_FALSE(replayed.divergence());
  EXPECT_TRUE(replayed.atEnd());
}

TEST_F(RecordingDevicesTest, SayWhenACommandIsAnother)
{
  see(recording, 3);
  recording.finish();
  ReplayedDevices replayed = replay();
  replayed.base().drive({0.1, 0.0});
  EXPECT_FALSE(replayed.divergence());
  replayed.clock().sleepUntil({});
  replayed.base().drive({0.3, 0.0});
  ASSERT_TRUE(replayed.divergence());
  EXPECT_EQ(replayed.divergence()->recorded->v, 0.2);
  EXPECT_EQ(replayed.divergence()->now->v, 0.3);
}

TEST_F(RecordingDevicesTest, SayWhenACommandIsMissingOrTooMuch)
{
  see(recording, 1);
  recording.finish();
  const std::deque<Tick> kept = ticks;
  ReplayedDevices fewer = replay();
  fewer.clock().sleepUntil({});
  EXPECT_FALSE(fewer.divergence()->now);
  ticks = kept;
  ReplayedDevices more = replay();
  more.base().drive({0.1, 0.0});
  more.base().drive({0.1, 0.0});
  EXPECT_FALSE(more.divergence()->recorded);
}

TEST_F(RecordingDevicesTest, FailAgainWhereTheyFailed)
{
  see(recording, 1);
  recording.base().state();
  robot.fails = true;
  EXPECT_THROW(recording.base().drive({}), DeviceError);
  recording.finish();
  ReplayedDevices replayed = replay();
  see(replayed, 1);
  EXPECT_NO_THROW(replayed.base().state());
  EXPECT_THROW(replayed.base().drive({}), DeviceError);
  EXPECT_TRUE(replayed.atEnd());
}

TEST_F(RecordingDevicesTest, AreStoppedAgainWhereTheyWereStopped)
{
  see(recording, 2);
  recording.base().state();
  stop = true;
  recording.base().state();
  recording.finish();
  ReplayedDevices replayed = replay();
  see(replayed, 2);
  replayed.base().state();
  EXPECT_FALSE(stopped);
  replayed.base().state();
  EXPECT_TRUE(stopped);
}

TEST_F(RecordingDevicesTest, EndWhereTheRecordingEnds)
{
  see(recording, 2);
  ReplayedDevices replayed = replay(); // killed: without a last tick
  EXPECT_THROW(see(replayed, 3), RecordingEnded);
  EXPECT_FALSE(replayed.atEnd());
  replayed.base().drive({}); // whoever ends stops the robot
  EXPECT_FALSE(replayed.divergence());
}

TEST_F(RecordingDevicesTest, GiveThePictureBeforeForOneThatWasNotKept)
{
  recording.camera().grab();
  recording.camera().grab();
  recording.finish();
  ticks.front().frames[1]->image.release();
  ReplayedDevices replayed = replay();
  replayed.camera().grab();
  EXPECT_FALSE(replayed.missedPicture());
  EXPECT_EQ(replayed.camera().grab()->image.at<unsigned char>(0, 0), 1);
  EXPECT_TRUE(replayed.missedPicture());
}

} // namespace
} // namespace homeward
