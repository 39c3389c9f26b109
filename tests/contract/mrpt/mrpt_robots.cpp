// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract_room.h"
#include "../device_contract.h"
#include "fake_hokuyo.h"
#include "sim_process.h"
#include "test_paths.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/mrpt_lasers/mrpt_lasers.h>
#include <homeward/sim/simulator.h>

namespace homeward
{
namespace
{

/** What a UTM-30LX measures in the contract room, which stands still. */
std::vector<int> measured()
{
  SimulatorOptions options;
  options.start = kContractStart;
  options.laser.fieldOfView = radians(270.0);
  options.laser.step = radians(0.25);
  Simulator simulator(share(contractRoom()), testRobot(), testCamera(), options);
  simulator.clock().sleepUntil(Time(std::chrono::milliseconds(200)));
  std::vector<int> millimetres;
  const std::optional<Scan> seen = simulator.laser().scan();
  for (const float range : seen.value().ranges) {
    millimetres.push_back(std::isnan(range) ? 0 : static_cast<int>(std::lround(1000.0F * range)));
  }
  return millimetres;
}

/** A laser that MRPT drives, and nothing else. */
class MrptRobot : public ContractRobot
{
public:
  Clock &clock() override { return m_clock; }
  MobileBase *base() override { return nullptr; }
  ImageSource *camera() override { return nullptr; }

private:
  SteadyClock m_clock;
};

class HokuyoRobot final : public MrptRobot
{
public:
  LaserScanner *laser() override { return m_laser.get(); }

private:
  FakeHokuyo m_device{measured()};
  std::unique_ptr<LaserScanner> m_laser = openHokuyo(m_device.address());
};

class MrptSickRobot final : public MrptRobot
{
public:
  LaserScanner *laser() override { return m_laser.get(); }

private:
  SimProcess m_sim{
      {"--world",
       (std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/contract/contract_room.sdf")
           .string(),
       "--start", "4,5,0", "--threads", "1"}};
  std::unique_ptr<LaserScanner> m_laser = openMrptSick(m_sim.lmsPty());
};

INSTANTIATE_TEST_SUITE_P(
    Mrpt, DeviceContract,
    testing::Values(
        ContractParameter{"mrpt_hokuyo_tcp", [] { return std::make_unique<HokuyoRobot>(); }},
        ContractParameter{"mrpt_lms200_pty", [] { return std::make_unique<MrptSickRobot>(); }}));

TEST(MrptLaser, HasTheFieldOfViewOfTheDevice)
{
  FakeHokuyo device(measured());
  const auto laser = openHokuyo(device.address());
  const Scan scan = laser->scan().value();
  ASSERT_EQ(scan.ranges.size(), 1081U);
  EXPECT_NEAR(scan.angle(540), 0.0, radians(0.2));
  EXPECT_NEAR(scan.angleStep, radians(0.25), radians(0.001));
}

TEST(MrptLaser, ASilentLaserIsLost)
{
  FakeHokuyo device(measured());
  MrptLaserOptions options;
  options.silence = std::chrono::milliseconds(300);
  const auto laser = openHokuyo(device.address(), options);
  device.fallSilent();
  EXPECT_TRUE(soon([&] {
    try {
      laser->scan();
    }
    catch (const DeviceError &error) {
      return std::string(error.what()).find("has been silent") != std::string::npos;
    }
    return false;
  }));
}

TEST(MrptLaser, WithoutOneThereIsOneClearLine)
{
  MrptLaserOptions options;
  options.start = std::chrono::milliseconds(300);
  const auto complaint = [&](const std::string &address) {
    try {
      openHokuyo(address, options);
    }
    catch (const RuntimeError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint("tcp:127.0.0.1:1"),
            "Hokuyo laser at tcp:127.0.0.1:1: no scan comes; is it on and the address right?");
  EXPECT_EQ(complaint("/dev/nowhere"),
            "Hokuyo laser at /dev/nowhere: no scan comes; is it on and the address right?");
  EXPECT_NE(complaint("nowhere").find("'tcp:HOST:PORT'"), std::string::npos);
}

} // namespace
} // namespace homeward
