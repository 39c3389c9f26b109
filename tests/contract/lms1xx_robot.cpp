// SPDX-License-Identifier: GPL-3.0-or-later
#include "../drivers/fake_lms1xx.h"
#include "contract_room.h"
#include "device_contract.h"
#include "test_robot.h"

#include <homeward/drivers/cola_laser.h>
#include <homeward/sim/simulator.h>

namespace homeward
{
namespace
{

/** What a LMS1xx measures in the contract room, which stands still. */
ColaScan measured()
{
  SimulatorOptions options;
  options.start = kContractStart;
  options.laser.fieldOfView = radians(270.0);
  options.laser.step = radians(0.5);
  Simulator simulator(share(contractRoom()), testRobot(), testCamera(), options);
  simulator.clock().sleepUntil(Time(std::chrono::milliseconds(200)));
  ColaScan scan;
  scan.startAngle = -450000;
  scan.angleStep = 5000;
  const std::optional<Scan> seen = simulator.laser().scan();
  for (const float range : seen.value().ranges) {
    scan.counts.push_back(std::isnan(range)
                              ? std::uint16_t{0}
                              : static_cast<std::uint16_t>(std::lround(1000.0F * range)));
  }
  return scan;
}

/** A LMS1xx over TCP, and nothing else. */
class Lms1xxRobot final : public ContractRobot
{
public:
  Clock &clock() override { return m_clock; }
  MobileBase *base() override { return nullptr; }
  LaserScanner *laser() override { return &m_laser; }
  ImageSource *camera() override { return nullptr; }

private:
  SteadyClock m_clock;
  Line m_line = tcpLine();
  FakeLms1xx m_device{m_line.device, measured()};
  ColaLaser m_laser{std::move(m_line.driver), ColaOptions{}};
};

INSTANTIATE_TEST_SUITE_P(Lms1xx, DeviceContract,
                         testing::Values(ContractParameter{
                             "lms1xx_tcp", [] { return std::make_unique<Lms1xxRobot>(); }}));

} // namespace
} // namespace homeward
