// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace homeward
{

/**
 * Keys of standard input without Enter and without echo while it lives; Ctrl-C still interrupts,
 * Ctrl-Z is a key. The terminal is as it was before after the destructor, exit(), and every signal
 * that ends the program but SIGKILL. One at a time.
 */
class RawTerminal
{
public:
  /** Changes nothing unless standard input is a terminal and this program is in its foreground. */
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal &) = delete;
  RawTerminal &operator=(const RawTerminal &) = delete;

  /** There are keys to be pressed. */
  bool hasKeys() const { return m_hasKeys; }

  /** Gives the terminal back; a signal handler may call it. */
  static void restoreNow();

private:
  bool m_hasKeys = false;
};

} // namespace homeward
