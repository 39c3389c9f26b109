// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract_room.h"
#include "device_contract.h"
#include "test_robot.h"

#include <homeward/sim/simulator.h>

namespace homeward
{
namespace
{

SimulatorOptions contractOptions()
{
  SimulatorOptions options;
  options.start = kContractStart;
  return options;
}

class SimulatorRobot : public ContractRobot
{
public:
  Clock &clock() override { return m_simulator.clock(); }
  MobileBase *base() override { return &m_simulator.base(); }
  LaserScanner *laser() override { return &m_simulator.laser(); }
  ImageSource *camera() override { return &m_simulator.camera(); }

private:
  Simulator m_simulator{share(contractRoom()), testRobot(), testCamera(), contractOptions()};
};

INSTANTIATE_TEST_SUITE_P(Simulator, DeviceContract,
                         testing::Values(ContractParameter{
                             "simulator", [] { return std::make_unique<SimulatorRobot>(); }}));

} // namespace
} // namespace homeward
