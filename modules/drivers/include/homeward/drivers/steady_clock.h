// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/robot/clock.h>

namespace homeward
{

/** The machine's steady clock, in which every driver stamps what it measures. */
class SteadyClock final : public Clock
{
public:
  Time now() const override;
  void sleepUntil(Time instant) override;
};

} // namespace homeward
