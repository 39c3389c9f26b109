// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/camera_sources.h>
#include <homeward/drivers/live_camera.h>

#include "fake_device.h"

#include <atomic>
#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;

/** What a scripted source does when it is asked next. */
enum class Act
{
  New,    ///< a picture of the next gray value
  Same,   ///< the last one again
  Break,  ///< DeviceError
  End,    ///< nothing more
  Nothing ///< lets its caller wait
};

/** Shared with the source that a camera owns. */
struct Script
{
  std::atomic<Act> act{Act::New};
  std::atomic<int> asked{0};
  std::atomic<int> value{0};
};

class ScriptedSource final : public ImageSource
{
public:
  explicit ScriptedSource(Script &script) : m_script(script) {}

  std::optional<Frame> grab() override
  {
    SteadyClock clock;
    clock.sleepUntil(clock.now() + std::chrono::milliseconds(2));
    while (m_script.act == Act::Nothing) {
      clock.sleepUntil(clock.now() + std::chrono::milliseconds(1));
    }
    ++m_script.asked;
    switch (m_script.act) {
    case Act::Break:
      throw DeviceError("unplugged");
    case Act::End:
      return std::nullopt;
    case Act::New:
      ++m_script.value;
      break;
    default:
      break;
    }
    return Frame{clock.now(), cv::Mat(2, 2, CV_32SC1, cv::Scalar::all(m_script.value))};
  }

private:
  Script &m_script;
};

CaptureOptions quick()
{
  CaptureOptions options;
  options.silence = std::chrono::milliseconds(200);
  options.start = std::chrono::milliseconds(500);
  return options;
}

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

TEST(LiveCamera, GivesTheNewestPictureAndCountsTheOthers)
{
  Script script;
  LiveCamera camera(std::make_unique<ScriptedSource>(script), quick());
  const int first = camera.grab()->image.at<int>(0, 0);
  ASSERT_TRUE(soon([&] { return camera.counters().taken > 20; }));
  const int later = camera.grab()->image.at<int>(0, 0);
  EXPECT_GT(later, first + 10);
  const CaptureCounters counters = camera.counters();
  EXPECT_EQ(counters.used, 2U);
  EXPECT_GE(counters.dropped + counters.used + 1, counters.taken);
  EXPECT_LE(counters.dropped + counters.used, counters.taken);
}

TEST(LiveCamera, StampsAreWhenTheLightCame)
{
  Script script;
  CaptureOptions options = quick();
  options.latency = std::chrono::milliseconds(70);
  LiveCamera camera(std::make_unique<ScriptedSource>(script), options);
  const std::optional<Frame> frame = camera.grab();
  const std::optional<Time> newest = camera.newest();
  ASSERT_TRUE(frame && newest);
  EXPECT_LE(frame->stamp + options.latency, *newest);
  EXPECT_TRUE(soon([&] { return camera.grab()->stamp > frame->stamp; }));
}

TEST(LiveCamera, AFrozenPictureIsNoNewOne)
{
  Script script;
  LiveCamera camera(std::make_unique<ScriptedSource>(script), quick());
  script.act = Act::Same;
  EXPECT_TRUE(soon(
      [&] { return complaint([&] { camera.grab(); }).find("nothing new") != std::string::npos; }));
  EXPECT_GT(camera.counters().repeated, 0U);
  script.act = Act::New;
  EXPECT_TRUE(soon([&] { return complaint([&] { camera.grab(); }).empty(); }));
}

TEST(LiveCamera, ABrokenSourceIsSaidAndComesBack)
{
  Script script;
  LiveCamera camera(std::make_unique<ScriptedSource>(script), quick());
  script.act = Act::Break;
  EXPECT_TRUE(soon(
      [&] { return complaint([&] { camera.grab(); }).find("unplugged") != std::string::npos; }));
  script.act = Act::New;
  EXPECT_TRUE(soon([&] { return complaint([&] { camera.grab(); }).empty(); }));
}

TEST(LiveCamera, ASourceThatHangsIsSilent)
{
  Script script;
  LiveCamera camera(std::make_unique<ScriptedSource>(script), quick());
  script.act = Act::Nothing;
  EXPECT_TRUE(soon(
      [&] { return complaint([&] { camera.grab(); }).find("nothing new") != std::string::npos; }));
  script.act = Act::New; // or its thread never ends
}

TEST(LiveCamera, ASourceThatEndsGivesItsLastPictureOnce)
{
  Script script;
  LiveCamera camera(std::make_unique<ScriptedSource>(script), quick());
  ASSERT_TRUE(soon([&] { return camera.counters().taken > 2; }));
  script.act = Act::End;
  EXPECT_TRUE(soon([&] { return !camera.grab(); }));
  EXPECT_FALSE(camera.grab());
}

TEST(LiveCamera, WithoutAFirstPictureItIsRefused)
{
  Script script;
  script.act = Act::Break;
  EXPECT_THAT(complaint([&] { LiveCamera(std::make_unique<ScriptedSource>(script), quick()); }),
              HasSubstr("unplugged"));
}

TEST(CameraSources, WhatIsNotThereIsNamed)
{
  EXPECT_THROW(openV4l2Camera(4711), ConfigError);
  EXPECT_THAT(complaint([] { openStreamCamera("http://127.0.0.1:1/camera.mjpg"); }),
              HasSubstr("http://127.0.0.1:1/camera.mjpg"));
}

} // namespace
} // namespace homeward
