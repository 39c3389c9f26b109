// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/robot/clock.h>
#include <homeward/robot/mobile_base.h>

namespace homeward
{

/** A base that takes its command at once. */
class IdealBase : public MobileBase
{
public:
  void drive(const Twist2 &twist) override { told.velocity = twist; }
  BaseState state() override { return told; }
  void move(double seconds) { told.odometry = told.odometry * integrate(told.velocity, seconds); }

  BaseState told;
};

/** Time that passes when it is told to. */
class HandClock : public Clock
{
public:
  Time now() const override { return m_now; }
  void sleepUntil(Time instant) override { m_now = instant; }

private:
  Time m_now{};
};

} // namespace homeward
