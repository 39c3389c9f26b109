// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/cola_laser.h>

#include "fake_lms1xx.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;

ColaScan halfDegrees()
{
  ColaScan scan;
  scan.begun = 1000;
  scan.sent = 11000;
  scan.startAngle = -450000;
  scan.angleStep = 5000;
  scan.counts.assign(541, 1500);
  scan.counts[540] = 4000;
  return scan;
}

ColaOptions quickOptions()
{
  ColaOptions options;
  options.answerTimeout = std::chrono::milliseconds(300);
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

TEST(ColaLaser, ConfiguresAndMeasures)
{
  Line line = tcpLine();
  FakeLms1xx device(line.device, halfDegrees());
  {
    const Time begin = SteadyClock().now();
    ColaLaser laser(std::move(line.driver), quickOptions());
    EXPECT_TRUE(device.heard("sMN mLMPsetscancfg +5000 +1 +5000 -450000 +2250000"));
    std::optional<Scan> scan;
    ASSERT_TRUE(soon([&] { return (scan = laser.scan()).has_value(); }));
    ASSERT_EQ(scan->ranges.size(), 541U);
    EXPECT_NEAR(scan->angleMin, radians(-135.0), 1e-9);
    EXPECT_NEAR(scan->angle(540), radians(135.0), 1e-6);
    EXPECT_FLOAT_EQ(scan->ranges[0], 1.5F);
    EXPECT_FLOAT_EQ(scan->ranges[540], 4.0F);
    EXPECT_GT(scan->stamp, begin);
    EXPECT_LE(scan->stamp, SteadyClock().now() - std::chrono::milliseconds(10)); // it took so long
    const Time first = scan->stamp;
    EXPECT_TRUE(soon([&] { return laser.scan()->stamp > first; }));
  }
  EXPECT_TRUE(device.heard("sEN LMDscandata 0"));
}

TEST(ColaLaser, ScansOfAnotherResolutionAreNotTaken)
{
  Line line = tcpLine();
  FakeLms1xx device(line.device, halfDegrees());
  ColaOptions options = quickOptions();
  options.resolution = 25;
  options.silence = std::chrono::milliseconds(300);
  ColaLaser laser(std::move(line.driver), options);
  EXPECT_TRUE(
      soon([&] { return complaint([&] { laser.scan(); }).find("silent") != std::string::npos; }));
}

TEST(ColaLaser, RefusalsAreSaid)
{
  for (const std::string refused : {"sMN SetAccessMode", "sMN mLMPsetscancfg", "sWN LMDscandatacfg",
                                    "sMN Run", "sEN LMDscandata 1"}) {
    Line line = tcpLine();
    FakeLms1xx device(line.device, halfDegrees());
    device.refuse(refused);
    EXPECT_THAT(complaint([&] { ColaLaser(std::move(line.driver), quickOptions()); }),
                HasSubstr("refuses '" + refused));
  }
}

TEST(ColaLaser, NobodyAnswers)
{
  Line line = tcpLine();
  ColaOptions options = quickOptions();
  options.answerTimeout = std::chrono::milliseconds(20);
  EXPECT_THAT(complaint([&] { ColaLaser(std::move(line.driver), options); }),
              HasSubstr("no answer to 'sMN SetAccessMode"));
  ::close(line.device);
}

TEST(ColaLaser, ASilentLaserIsLost)
{
  Line line = tcpLine();
  FakeLms1xx device(line.device, halfDegrees());
  ColaOptions options = quickOptions();
  options.silence = std::chrono::milliseconds(200);
  ColaLaser laser(std::move(line.driver), options);
  device.fallSilent();
  EXPECT_TRUE(
      soon([&] { return complaint([&] { laser.scan(); }).find("silent") != std::string::npos; }));
}

TEST(ColaLaser, ALaserThatIsUnpluggedIsLost)
{
  Line line = tcpLine();
  FakeLms1xx device(line.device, halfDegrees());
  ColaLaser laser(std::move(line.driver), quickOptions());
  device.hangUp();
  EXPECT_TRUE(
      soon([&] { return complaint([&] { laser.scan(); }).find("is lost") != std::string::npos; }));
}

TEST(ColaLaser, AResolutionItCannotHaveIsRefused)
{
  Line line = tcpLine();
  ColaOptions options = quickOptions();
  options.resolution = 100;
  EXPECT_THROW(ColaLaser(std::move(line.driver), options), LogicError);
  ::close(line.device);
}

} // namespace
} // namespace homeward
