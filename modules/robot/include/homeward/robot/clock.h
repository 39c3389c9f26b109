// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/time.h>

namespace homeward
{

/** Where robot time comes from: the simulator's steps or the machine's steady clock. */
class Clock
{
public:
  virtual ~Clock() = default;

  virtual Time now() const = 0;

  /** Returns when `instant` has come; in simulation this is what makes the world move on. */
  virtual void sleepUntil(Time instant) = 0;
};

} // namespace homeward
