// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

namespace homeward
{

/** Set by Ctrl-C, a kill, a lost terminal or askToStop() from the first call on; a second Ctrl-C
 * ends the program. */
const std::atomic<bool> &stopSignal();

/** Sets what stopSignal() shows, as Ctrl-C does. */
void askToStop();

} // namespace homeward
