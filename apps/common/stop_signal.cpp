// SPDX-License-Identifier: GPL-3.0-or-later
#include "stop_signal.h"

#include <csignal>

namespace homeward
{
namespace
{

std::atomic<bool> stopWanted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void onSignal(int number)
{
  stopWanted = true;
  if (number == SIGINT) {
    std::signal(number, SIG_DFL); // a second Ctrl-C ends it at once
  }
}

} // namespace

const std::atomic<bool> &stopSignal()
{
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(number, onSignal);
  }
  return stopWanted;
}

} // namespace homeward
