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

  /** Never goes back. */
  virtual Time now() const = 0;

  /** Returns when `instant` has come; in simulation this is what makes the world move on. */
  virtual void sleepUntil(Time instant) = 0;

  /**
   * Whether a computation that runs beside the control loop counts as done: as it is, unless a
   * recorded run is replayed, where it counts as it did then.
   */
  virtual bool counts(bool done) { return done; }
};

} // namespace homeward
