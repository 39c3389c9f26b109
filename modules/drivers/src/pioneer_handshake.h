// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/protocol/arcos.h>

namespace homeward
{

/** A robot that has been opened. */
struct ArcosConnection
{
  ArcosIdentity identity;
  int baud = 0; ///< the speed at which it answered; 0 when none was set
};

/**
 * Brings a robot from any state to "open": SYNC0, SYNC1, SYNC2, OPEN. One that is open already and
 * streams is closed first. Where there are several speeds each is tried in turn, twice; one at
 * which any packet comes is the right one.
 * @param timeout for each answer
 * @param bauds speeds of a serial line; empty leaves it as it is set
 * @throw DeviceError when none answers; at a speed that the line does not have
 */
ArcosConnection shakeHands(ByteStream &stream, ArcosReader &reader, Duration timeout,
                           const std::vector<int> &bauds);

} // namespace homeward
