// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "raw_terminal.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace homeward
{

/**
 * The operator's hands while a robot drives. Without Enter, s, space and Ctrl-Z ask to stop; so
 * does any button of a joystick, one held at the beginning too, and a terminal or a joystick that
 * is gone.
 */
class OperatorInput
{
public:
  /**
   * Listens from now on, to the keys where standard input is a terminal.
   * @param joystick of the Linux joystick API: /dev/input/jsN; empty: none
   * @throw DeviceError when it does not open
   */
  explicit OperatorInput(const std::string &joystick);
  ~OperatorInput();
  OperatorInput(const OperatorInput &) = delete;
  OperatorInput &operator=(const OperatorInput &) = delete;

  bool hasKeys() const { return m_terminal.hasKeys(); }

  /** Waits for the key g. @return false when a stop was asked for first */
  bool awaitGo();

private:
  void listen();
  bool hearKeys();
  bool hearJoystick();

  const std::atomic<bool> &m_stop;
  int m_joystick = -1; ///< descriptor; none without
  int m_end = -1;      ///< descriptor of an event that ends the thread
  std::atomic<bool> m_go{false};
  std::vector<std::uint8_t> m_part; ///< of a joystick's record
  RawTerminal m_terminal;
  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace homeward
