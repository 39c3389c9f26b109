// SPDX-License-Identifier: GPL-3.0-or-later
#include "stop_signal.h"

#include "raw_terminal.h"

#include <csignal>

namespace homeward
{
namespace
{

std::atomic<bool> stopWanted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

/** A second Ctrl-C ends it at once. */
void onSecond(int number)
{
  RawTerminal::restoreNow();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void onSignal(int number)
{
  stopWanted = true;
  if (number == SIGINT) {
    std::signal(number, onSecond);
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

void askToStop()
{
  stopWanted = true;
}

} // namespace homeward
