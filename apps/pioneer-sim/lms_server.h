// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/sick.h>
#include <homeward/robot/laser_scanner.h>

#include <deque>
#include <span>

namespace homeward
{

/**
 * A SICK LMS-200 as its host meets it, without I/O: bytes in, bytes out, time as an argument. It is
 * deaf at the wrong speed, and no byte leaves it faster than its line carries it: 181 readings take
 * 97 ms at 38400 baud.
 */
class LmsServer
{
public:
  LmsServer();

  /** Takes what a host sent over a line that runs at `lineBaud`. */
  void receive(std::span<const std::uint8_t> bytes, int lineBaud);

  /** @return what leaves it during a step of robot time that ends now */
  Bytes step(Duration span, LaserScanner &laser);

  /** Speed of its line, bits a second. */
  int baud() const { return m_baud; }

private:
  void obey(const Bytes &payload);
  void setMode(const Bytes &payload);
  void setBaud(int baud);
  void configure(const Bytes &payload);
  void setVariant(const Bytes &payload);
  void restart();
  void answer(Bytes payload);
  void send(std::span<const std::uint8_t> bytes);
  void measure(const Scan &scan);
  Bytes status() const;

  SickReader m_reader;
  std::deque<std::uint8_t> m_queue; ///< bytes not yet on the line
  double m_credit = 0.0;            ///< bytes that the line could have carried by now
  Bytes m_block;                    ///< configuration
  int m_baud = 9600;
  int m_nextBaud = 9600;   ///< when the queue is empty
  int m_fieldOfView = 180; ///< degrees
  int m_resolution = 100;  ///< hundredths of a degree
  bool m_installing = false;
  bool m_measuring = false;
};

} // namespace homeward
