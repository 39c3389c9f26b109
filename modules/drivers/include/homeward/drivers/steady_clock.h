// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/robot/clock.h>

namespace homeward
{

/**
 * The machine's steady clock, in which every driver stamps what it measures. All clocks of one rate
 * in a process show the same time.
 */
class SteadyClock final : public Clock
{
public:
  /** @param rate seconds of robot time in one of the machine's: 1 but for a simulated robot that
   * lives faster */
  explicit SteadyClock(double rate = 1.0) : m_rate(rate) {}

  Time now() const override;
  void sleepUntil(Time instant) override;

private:
  double m_rate;
};

} // namespace homeward
