// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/protocol/arcos.h>

namespace homeward
{

/**
 * Brings a robot from any state to "open": SYNC0, SYNC1, SYNC2, OPEN. One that is open already and
 * streams is closed first.
 * @param timeout for each answer; a few tries are made
 * @return what the robot says of itself
 * @throw DeviceError when none answers
 */
ArcosIdentity shakeHands(ByteStream &stream, ArcosReader &reader, Duration timeout);

} // namespace homeward
