// SPDX-License-Identifier: GPL-3.0-or-later
#include "raw_terminal.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <termios.h>
#include <unistd.h>

namespace homeward
{
namespace
{

/** What ends a program without its destructors; each is raised again once the terminal is back. */
constexpr std::array kFatal = {SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

termios before{};
std::atomic<bool> changed{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler reads it");
std::array<struct sigaction, kFatal.size()> handlersBefore{};

void onFatal(int number)
{
  RawTerminal::restoreNow();
  for (std::size_t i = 0; i < kFatal.size(); ++i) {
    if (kFatal[i] == number) {
      ::sigaction(number, &handlersBefore[i], nullptr);
    }
  }
  std::raise(number); // when this handler has returned
}

} // namespace

RawTerminal::RawTerminal()
{
  if (::tcgetattr(STDIN_FILENO, &before) != 0 || ::tcgetpgrp(STDIN_FILENO) != ::getpgrp()) {
    return;
  }
  termios raw = before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  raw.c_cc[VSUSP] = _POSIX_VDISABLE; // who sleeps cannot stop a robot
  static const int restoring = std::atexit(&RawTerminal::restoreNow);
  struct sigaction action
  {};
  action.sa_handler = onFatal;
  for (std::size_t i = 0; i < kFatal.size(); ++i) {
    ::sigaction(kFatal[i], &action, &handlersBefore[i]);
  }
  changed = true;
  m_hasKeys = restoring == 0 && ::tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
}

RawTerminal::~RawTerminal()
{
  if (!changed) {
    return;
  }
  restoreNow();
  for (std::size_t i = 0; i < kFatal.size(); ++i) {
    ::sigaction(kFatal[i], &handlersBefore[i], nullptr);
  }
}

void RawTerminal::restoreNow()
{
  if (!changed.exchange(false)) {
    return;
  }
  // From the background the terminal would stop us instead.
  sigset_t background;
  sigset_t masked;
  ::sigemptyset(&background);
  ::sigaddset(&background, SIGTTOU);
  ::pthread_sigmask(SIG_BLOCK, &background, &masked);
  ::tcsetattr(STDIN_FILENO, TCSANOW, &before);
  ::pthread_sigmask(SIG_SETMASK, &masked, nullptr);
}

} // namespace homeward
