// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/robot/rig.h>

#include "test_paths.h"

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

namespace homeward
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kFiles = "robot: ../robots/cart.urdf\ncamera: ../cameras/dome.yaml\n";

std::string refusal(const std::string &yaml)
{
  try {
    parseRig(yaml, "rig.yaml");
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return {};
}

TEST(Rig, ReadsFilesAndLimitsInSi)
{
  const Rig rig = parseRig(kFiles + "limits: {max_speed_m_s: 0.5, max_turn_rate_deg_s: 90, "
                                    "acceleration_m_s2: 0.25, deceleration_m_s2: 1}\n",
                           "rig.yaml");
  EXPECT_EQ(rig.robot, "../robots/cart.urdf");
  EXPECT_EQ(rig.camera, "../cameras/dome.yaml");
  EXPECT_DOUBLE_EQ(rig.limits.maxSpeed, 0.5);
  EXPECT_DOUBLE_EQ(rig.limits.maxTurnRate, kPi / 2.0);
  EXPECT_DOUBLE_EQ(rig.limits.acceleration, 0.25);
  EXPECT_DOUBLE_EQ(rig.limits.deceleration, 1.0);
}

TEST(Rig, LimitsLeftOutKeepTheirDefaults)
{
  const Rig rig = parseRig(kFiles + "limits: {max_speed_m_s: 0.2}\n", "rig.yaml");
  EXPECT_DOUBLE_EQ(rig.limits.maxSpeed, 0.2);
  EXPECT_DOUBLE_EQ(rig.limits.maxTurnRate, Limits{}.maxTurnRate);
}

TEST(Rig, RefusalsNameFileKeyAndValue)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"robot: a.urdf\n", "'camera' is missing"},
      {"camera: a.yaml\n", "'robot' is missing"},
      {kFiles + "wings: 2\n", "unknown key 'wings'"},
      {kFiles + "limits: {max_sped: 1}\n", "unknown key 'limits.max_sped'"},
      {kFiles + "limits: {max_speed_m_s: fast}\n", "'limits.max_speed_m_s' is 'fast'"},
      {kFiles + "limits: {max_speed_m_s: 0}\n", "'limits.max_speed_m_s' is '0'"},
      {kFiles + "limits: {max_speed_m_s: -1}\n", "'-1'"},
      {kFiles + "limits: {max_speed_m_s: .nan}\n", "'.nan'"},
      {kFiles + "limits: {max_speed_m_s: [1]}\n", "'limits.max_speed_m_s' is a list"},
      {kFiles + "limits: 3\n", "'limits' is '3'"},
      {"robot: [a]\ncamera: b\n", "'robot' is a list"},
      {"just words", "no keys and values"},
      {"", "no keys and values"},
      {"robot: {", "not YAML"},
      {"? [a]\n: b\n", "unknown key ''"},
  };
  for (const auto &[yaml, culprit] : cases) {
    EXPECT_THAT(refusal(yaml), AllOf(StartsWith("rig.yaml: "), HasSubstr(culprit))) << yaml;
  }
}

const std::string kBase = "base: {address: 'tcp:localhost:8101'}\n";
const std::string kLaser = "laser: {kind: on_base}\n";
const std::string kCapture = "capture: {kind: stream, source: 'http://localhost/camera'}\n";

TEST(Rig, ReadsRealDevices)
{
  const Rig rig = parseRig(
      kFiles + "base: {address: /dev/ttyUSB0, baud: 38400, period_s: 0.2, parameters: ../p3at.p}\n"
               "laser: {kind: lms200, address: /dev/ttyUSB1, baud: 19200, resolution_deg: 0.5}\n"
               "capture: {kind: v4l2, source: 2, period_s: 0.04, latency_s: 0.08}\n"
               "stop_joystick: /dev/input/js0\n"
               "clock_rate: 4\n",
      "rig.yaml");
  ASSERT_TRUE(rig.devices);
  EXPECT_EQ(rig.devices->base.address, "/dev/ttyUSB0");
  EXPECT_EQ(rig.devices->base.baud, 38400);
  EXPECT_DOUBLE_EQ(rig.devices->base.period, 0.2);
  EXPECT_EQ(rig.devices->base.parameters, "../p3at.p");
  EXPECT_EQ(rig.devices->stopJoystick, "/dev/input/js0");
  EXPECT_EQ(rig.devices->laser.kind, LaserLink::Kind::Lms200);
  EXPECT_EQ(rig.devices->laser.address, "/dev/ttyUSB1");
  EXPECT_EQ(rig.devices->laser.baud, 19200);
  EXPECT_EQ(rig.devices->laser.resolution, 50);
  EXPECT_EQ(rig.devices->capture.kind, CaptureLink::Kind::V4l2);
  EXPECT_EQ(rig.devices->capture.source, "2");
  EXPECT_DOUBLE_EQ(rig.devices->capture.period, 0.04);
  EXPECT_DOUBLE_EQ(rig.devices->capture.latency, 0.08);
  EXPECT_DOUBLE_EQ(rig.devices->clockRate, 4.0);
}

TEST(Rig, ReadsALaserOnEthernet)
{
  const auto laser = [](const std::string &resolution) {
    return parseRig(kFiles + kBase + "laser: {kind: lms1xx, address: 'tcp:10.0.0.2:2111'" +
                        resolution + "}\n" + kCapture,
                    "rig.yaml")
        .devices->laser;
  };
  EXPECT_EQ(laser("").kind, LaserLink::Kind::Lms1xx);
  EXPECT_EQ(laser("").address, "tcp:10.0.0.2:2111");
  EXPECT_EQ(laser("").resolution, 50);
  EXPECT_EQ(laser(", resolution_deg: 0.25").resolution, 25);
  EXPECT_EQ(parseRig(kFiles + kBase + "laser: {kind: hokuyo, address: /dev/ttyACM0}\n" + kCapture,
                     "rig.yaml")
                .devices->laser.kind,
            LaserLink::Kind::Hokuyo);
}

TEST(Rig, ReadsExposureAndGain)
{
  const auto capture = [](const std::string &keys) {
    return parseRig(kFiles + kBase + kLaser + "capture: {source: 0, " + keys + "}\n", "rig.yaml")
        .devices->capture;
  };
  EXPECT_FALSE(capture("kind: v4l2").exposure);
  EXPECT_FALSE(capture("kind: v4l2").gain);
  EXPECT_DOUBLE_EQ(*capture("kind: v4l2, exposure_ms: 8.5, gain: 0").exposure, 0.0085);
  EXPECT_EQ(capture("kind: v4l2, exposure_ms: 8.5, gain: 0").gain, 0);
  EXPECT_EQ(capture("kind: firewire, shutter: 400").kind, CaptureLink::Kind::Firewire);
  EXPECT_EQ(capture("kind: firewire, shutter: 400").shutter, 400);
}

TEST(Rig, WithoutDevicesItIsSimulated)
{
  EXPECT_FALSE(parseRig(kFiles, "rig.yaml").devices);
  const DeviceLinks devices =
      parseRig(kFiles + kBase + kLaser + kCapture, "rig.yaml").devices.value();
  EXPECT_DOUBLE_EQ(devices.clockRate, 1.0);
  EXPECT_TRUE(devices.base.parameters.empty() && devices.stopJoystick.empty());
}

TEST(Rig, RefusalsOfDevicesNameFileKeyAndValue)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {kBase, "'laser' is missing"},
      {kBase + kLaser, "'capture' is missing"},
      {kLaser + kCapture, "'base' is missing"},
      {"clock_rate: 2\n", "'base' is missing"},
      {"base: here\n" + kLaser + kCapture, "'base' is 'here'"},
      {"base: {baud: 9600}\n" + kLaser + kCapture, "'base.address' is missing"},
      {"base: {address: [1]}\n" + kLaser + kCapture, "'base.address' is a list"},
      {"base: {address: x, speed: 1}\n" + kLaser + kCapture, "unknown key 'base.speed'"},
      {"base: {address: x, baud: -1}\n" + kLaser + kCapture, "'base.baud' is '-1'"},
      {"base: {address: x, parameters: [1]}\n" + kLaser + kCapture, "'base.parameters' is a list"},
      {kBase + kLaser + kCapture + "stop_joystick:\n", "'stop_joystick' is"},
      {"stop_joystick: js0\n", "'base' is missing"},
      {kBase + "laser: {kind: radar}\n" + kCapture, "'laser.kind' is 'radar'; one of lms200"},
      {kBase + "laser: {kind: lms200}\n" + kCapture, "'laser.address' is missing"},
      {kBase + "laser: {kind: lms200, address: x, baud: 4e77}\n" + kCapture,
       "'laser.baud' is '4e77'"},
      {kBase + "laser: {kind: lms200, address: x, baud: 38400000000000000}\n" + kCapture,
       "'laser.baud' is '38400000000000000'"},
      {kBase + "laser: {kind: lms200, address: x, resolution_deg: 0.25}\n" + kCapture,
       "'laser.resolution_deg' is '0.25'"},
      {kBase + "laser: {kind: lms1xx, address: x, resolution_deg: 1e77}\n" + kCapture,
       "'laser.resolution_deg' is '1e77'"},
      {kBase + "laser: {kind: lms1xx, address: x, baud: 1}\n" + kCapture,
       "unknown key 'laser.baud'"},
      {kBase + "laser: {kind: hokuyo, address: x, resolution_deg: 1}\n" + kCapture,
       "unknown key 'laser.resolution_deg'"},
      {kBase + "laser: {kind: on_base, baud: 1}\n" + kCapture, "unknown key 'laser.baud'"},
      {kBase + kLaser + "capture: {kind: eye, source: x}\n", "'capture.kind' is 'eye'"},
      {kBase + kLaser + "capture: {kind: v4l2, source: 0, exposure_ms: 0}\n",
       "'capture.exposure_ms' is '0'"},
      {kBase + kLaser + "capture: {kind: v4l2, source: 0, gain: -1}\n", "'capture.gain' is '-1'"},
      {kBase + kLaser + "capture: {kind: v4l2, source: 0, gain: 1.5}\n", "'capture.gain' is '1.5'"},
      {kBase + kLaser + "capture: {kind: stream, source: x, gain: 1}\n",
       "unknown key 'capture.gain'"},
      {kBase + kLaser + "capture: {kind: v4l2, source: 0, shutter: 1}\n",
       "unknown key 'capture.shutter'"},
      {kBase + kLaser + kCapture + "clock_rate: 0\n", "'clock_rate' is '0'"},
  };
  for (const auto &[yaml, culprit] : cases) {
    EXPECT_THAT(refusal(kFiles + yaml), AllOf(StartsWith("rig.yaml: "), HasSubstr(culprit)))
        << yaml;
  }
}

TEST(Rig, LimitsOfABaseStandAlone)
{
  const Limits limits = parseLimits("turn_acceleration_deg_s2: 180\n", "base.yaml");
  EXPECT_DOUBLE_EQ(limits.turnAcceleration, kPi);
  EXPECT_DOUBLE_EQ(limits.maxSpeed, Limits{}.maxSpeed);
  EXPECT_THROW(parseLimits("robot: a\n", "base.yaml"), ConfigError);
}

TEST(Rig, EveryShippedRobotsLimitsAreRead)
{
  std::size_t count = 0;
  for (const auto &entry : std::filesystem::directory_iterator(dataDir() / "robots")) {
    if (entry.path().extension() == ".yaml") {
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      EXPECT_GT(parseLimits(text.str(), entry.path().string()).maxSpeed, 0.0);
      ++count;
    }
  }
  EXPECT_GT(count, 0U) << "no limits in " << dataDir();
}

TEST(Rig, EveryShippedRigIsRead)
{
  std::size_t count = 0;
  for (const auto &entry : std::filesystem::directory_iterator(dataDir() / "rigs")) {
    if (entry.path().extension() != ".yaml") {
      continue;
    }
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const Rig rig = parseRig(text.str(), entry.path().filename().string());
    EXPECT_TRUE(std::filesystem::exists(entry.path().parent_path() / rig.robot)) << entry.path();
    EXPECT_TRUE(std::filesystem::exists(entry.path().parent_path() / rig.camera)) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0U) << "no rigs in " << dataDir();
}

} // namespace
} // namespace homeward
