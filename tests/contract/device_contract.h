// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/robot/clock.h>
#include <homeward/robot/image_source.h>
#include <homeward/robot/laser_scanner.h>
#include <homeward/robot/mobile_base.h>

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <ostream>
#include <string>

namespace homeward
{

/**
 * One implementation of the devices, with the robot of test_robot.h standing in contractRoom() of
 * contract_room.h at kContractStart. A device that the implementation does not have is null.
 */
class ContractRobot
{
public:
  virtual ~ContractRobot() = default;
  virtual Clock &clock() = 0;
  virtual MobileBase *base() = 0;
  virtual LaserScanner *laser() = 0;
  virtual ImageSource *camera() = 0;
};

/** How the suite gets a fresh robot of one implementation. */
struct ContractParameter
{
  std::string name;
  std::function<std::unique_ptr<ContractRobot>()> make;
};

inline std::ostream &operator<<(std::ostream &stream, const ContractParameter &parameter)
{
  return stream << parameter.name;
}

/**
 * What every implementation of the device interfaces must do. To put another one to the test,
 * instantiate the suite with INSTANTIATE_TEST_SUITE_P, as simulator_robot.cpp does.
 */
class DeviceContract : public testing::TestWithParam<ContractParameter>
{
protected:
  DeviceContract() : robot(GetParam().make()) {}

  /** Lets time pass. */
  void wait(double seconds)
  {
    robot->clock().sleepUntil(robot->clock().now() + fromSeconds(seconds));
  }

  /** Drives for `seconds`, commanding ten times a second. */
  void drive(const Twist2 &twist, double seconds)
  {
    for (double passed = 0.0; passed < seconds - 0.05; passed += 0.1) {
      robot->base()->drive(twist);
      wait(0.1);
    }
  }

  /** Drives, then stands still. */
  void driveAndStop(const Twist2 &twist, double seconds)
  {
    drive(twist, seconds);
    drive({}, 2.0);
  }

  std::unique_ptr<ContractRobot> robot;
};

#define HOMEWARD_NEEDS_DEVICE(device)                                                              \
  if (robot->device() == nullptr) {                                                                \
    GTEST_SKIP() << GetParam().name << " has no " #device;                                         \
  }                                                                                                \
  static_assert(true, "")

} // namespace homeward
