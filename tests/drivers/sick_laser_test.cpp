// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/sick_laser.h>

#include "fake_sick.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;

SickOptions quickOptions()
{
  SickOptions options;
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

TEST(SickLaser, FindsConfiguresAndMeasures)
{
  Line line = serialLine();
  FakeSick device(line.device);
  {
    SickLaser laser(std::move(line.driver), quickOptions());
    EXPECT_TRUE(device.eventually([&] { return device.speed() == B38400; }));
    EXPECT_TRUE(
        device.eventually([&] { return device.block().at(5) == 6 && device.block().at(6) == 1; }));
    std::optional<Scan> scan;
    ASSERT_TRUE(soon([&] { return (scan = laser.scan()).has_value(); }));
    ASSERT_EQ(scan->ranges.size(), 181U);
    EXPECT_DOUBLE_EQ(scan->angleMin, -kPi / 2.0);
    EXPECT_NEAR(scan->angleStep, radians(1.0), 1e-12);
    EXPECT_FLOAT_EQ(scan->ranges[0], 1.0F);
    EXPECT_FLOAT_EQ(scan->ranges[180], 1.18F);
    const Time first = scan->stamp;
    EXPECT_TRUE(soon([&] { return laser.scan()->stamp > first; }));
    device.forget();
  }
  EXPECT_TRUE(device.heard({0x20, 0x25}));
}

TEST(SickLaser, MeasuresInHalfDegrees)
{
  Line line = serialLine();
  FakeSick device(line.device);
  SickOptions options = quickOptions();
  options.resolution = 50;
  SickLaser laser(std::move(line.driver), options);
  std::optional<Scan> scan;
  ASSERT_TRUE(soon([&] { return (scan = laser.scan()).has_value(); }));
  EXPECT_EQ(scan->ranges.size(), 361U);
}

TEST(SickLaser, LeavesAMemoryAloneThatIsRight)
{
  Line line = serialLine();
  FakeSick device(line.device, 6, 1);
  const SickLaser laser(std::move(line.driver), quickOptions());
  EXPECT_TRUE(device.heard({0x20, 0x24}));
  EXPECT_TRUE(device.eventually([&] {
    return !device.hasHeard({0x77}) && !device.hasHeard({0x20, 0x00});
  }));
}

TEST(SickLaser, ARefusedPasswordIsSaid)
{
  Line line = serialLine();
  FakeSick device(line.device);
  device.refusePassword();
  EXPECT_THAT(complaint([&] { SickLaser(std::move(line.driver), quickOptions()); }),
              HasSubstr("password"));
}

TEST(SickLaser, NobodyAnswers)
{
  Line line = serialLine();
  SickOptions options = quickOptions();
  options.answerTimeout = std::chrono::milliseconds(10);
  EXPECT_THAT(complaint([&] { SickLaser(std::move(line.driver), options); }),
              HasSubstr("no SICK laser answers"));
  ::close(line.device);
}

TEST(SickLaser, ASilentLaserIsLost)
{
  Line line = serialLine();
  FakeSick device(line.device);
  SickOptions options = quickOptions();
  options.silence = std::chrono::milliseconds(200);
  SickLaser laser(std::move(line.driver), options);
  device.fallSilent();
  EXPECT_TRUE(
      soon([&] { return complaint([&] { laser.scan(); }).find("silent") != std::string::npos; }));
}

TEST(SickLaser, ALaserThatIsUnpluggedIsLost)
{
  Line line = serialLine();
  FakeSick device(line.device);
  SickLaser laser(std::move(line.driver), quickOptions());
  device.hangUp();
  EXPECT_TRUE(
      soon([&] { return complaint([&] { laser.scan(); }).find("is lost") != std::string::npos; }));
}

TEST(SickLaser, WhatTheScannerCannotDoIsRefused)
{
  for (const auto &[fieldOfView, resolution] : {std::pair{180, 25}, {90, 100}, {100, 33}}) {
    Line line = serialLine();
    SickOptions options = quickOptions();
    options.fieldOfView = fieldOfView;
    options.resolution = resolution;
    EXPECT_THROW(SickLaser(std::move(line.driver), options), LogicError);
    ::close(line.device);
  }
}

} // namespace
} // namespace homeward
