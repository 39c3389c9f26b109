// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract_room.h"
#include "device_contract.h"
#include "test_robot.h"

#include <homeward/sim/simulator.h>
#include <homeward/visp_base/base_robot.h>
#include <homeward/visp_base/visp_base.h>

namespace homeward
{
namespace
{

/** The simulated robot, as a robot of ViSP, as a base again. */
class VispRobot : public ContractRobot
{
public:
  VispRobot()
  {
    m_robot.setMaxTranslationVelocity(0.7);
    m_robot.setMaxRotationVelocity(2.0);
  }

  Clock &clock() override { return m_simulator.clock(); }
  MobileBase *base() override { return &m_base; }
  LaserScanner *laser() override { return &m_simulator.laser(); }
  ImageSource *camera() override { return &m_simulator.camera(); }

private:
  static SimulatorOptions options()
  {
    SimulatorOptions options;
    options.start = kContractStart;
    return options;
  }

  Simulator m_simulator{share(contractRoom()), testRobot(), testCamera(), options()};
  BaseRobot m_robot{m_simulator.base()};
  VispBase m_base{m_robot, m_simulator.clock(), {vpRobot::REFERENCE_FRAME, {}, [this] {
                                                   return m_robot.getVelocity(
                                                       vpRobot::REFERENCE_FRAME);
                                                 }}};
};

INSTANTIATE_TEST_SUITE_P(Visp, DeviceContract,
                         testing::Values(ContractParameter{
                             "visp", [] { return std::make_unique<VispRobot>(); }}));

} // namespace
} // namespace homeward
