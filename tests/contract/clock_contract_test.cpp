// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_contract.h"

namespace homeward
{
namespace
{

TEST_P(DeviceContract, sleepEndsWhenTheInstantHasCome)
{
  Clock &clock = robot->clock();
  const Time start = clock.now();
  for (const double seconds : {0.013, 0.1, 0.25}) {
    const Time instant = clock.now() + fromSeconds(seconds);
    clock.sleepUntil(instant);
    EXPECT_GE(clock.now(), instant);
    EXPECT_LT(toSeconds(clock.now() - instant), 0.1);
  }
  EXPECT_GT(clock.now(), start);
}

TEST_P(DeviceContract, sleepUntilThePastReturnsAtOnceAndTimeNeverRunsBack)
{
  Clock &clock = robot->clock();
  wait(0.5);
  const Time before = clock.now();
  clock.sleepUntil(before - fromSeconds(0.3));
  EXPECT_GE(clock.now(), before);
  EXPECT_LT(toSeconds(clock.now() - before), 0.1);
}

} // namespace
} // namespace homeward
